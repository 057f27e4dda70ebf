#include "host/report/picture/load_codec.h"

#include <atomic>

#include "host/core/program_module.h"

namespace glintmark {
namespace {

std::atomic<bool> has_worked_here = false;

const ImageCodec& loadedCodec() {
  static const ImageCodec& codec = *reinterpret_cast<ImageCodecFunction*>(
      moduleFunction("glintmark_codec.so", kImageCodecSymbol, "pictures need"))();
  return codec;
}

}  // namespace

const ImageCodec& imageCodec() {
  has_worked_here = true;
  return loadedCodec();
}

std::unique_ptr<StoredImage> openImage(const std::string& name, const ImageInMemory& memory,
                                       std::string& fault) {
  if (!has_worked_here) return openIsolated(loadedCodec(), name, memory, fault);
  if (memory.format.empty()) return loadedCodec().open(name, fault);
  return loadedCodec().open(memory.format, memory.bytes, fault);
}

}  // namespace glintmark
