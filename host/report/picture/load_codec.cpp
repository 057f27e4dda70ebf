#include "host/report/picture/load_codec.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "host/core/error.h"

namespace glintmark {
namespace fs = std::filesystem;
namespace {

constexpr char kModule[] = "glintmark_codec.so";

fs::path modulePath() {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path installed = (beside / "../lib/glintmark" / kModule).lexically_normal();
  return fs::exists(installed, error) ? installed : beside / kModule;
}

const ImageCodec& load() {
  const fs::path path = modulePath();
  // Never closed: its readers live as long as the program.
  void* module = dlopen(path.c_str(), RTLD_LAZY | RTLD_LOCAL);
  void* function = module == nullptr ? nullptr : dlsym(module, kImageCodecSymbol);
  if (function == nullptr) {
    const char* reason = dlerror();
    throw Error(fmt::format("pictures need {}, which cannot be loaded: {}", path.string(),
                            reason == nullptr ? "no reason is known" : reason));
  }
  return *reinterpret_cast<ImageCodecFunction*>(function)();
}

}  // namespace

const ImageCodec& imageCodec() {
  static const ImageCodec& codec = load();
  return codec;
}

}  // namespace glintmark
