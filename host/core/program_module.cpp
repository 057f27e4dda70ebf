#include "host/core/program_module.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include "host/core/error.h"

namespace glintmark {
namespace fs = std::filesystem;

fs::path modulePath(const std::string& file) {
  std::error_code error;
  const fs::path beside = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path installed = (beside / "../lib/glintmark" / file).lexically_normal();
  return fs::exists(installed, error) ? installed : beside / file;
}

void* moduleFunction(const std::string& file, const char* symbol, const std::string& need,
                     bool for_others) {
  const fs::path path = modulePath(file);
  void* module = dlopen(path.c_str(), RTLD_LAZY | (for_others ? RTLD_GLOBAL : RTLD_LOCAL));
  void* function = module == nullptr ? nullptr : dlsym(module, symbol);
  if (function != nullptr) return function;
  const char* reason = dlerror();
  throw Error(fmt::format("{} {}, which cannot be loaded: {}", need, path.string(),
                          reason == nullptr ? "no reason is known" : reason));
}

}  // namespace glintmark
