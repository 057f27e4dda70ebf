#include "host/report/picture/load_codec.h"

#include "host/core/program_module.h"

namespace glintmark {

const ImageCodec& imageCodec() {
  static const ImageCodec& codec = *reinterpret_cast<ImageCodecFunction*>(
      moduleFunction("glintmark_codec.so", kImageCodecSymbol, "pictures need"))();
  return codec;
}

}  // namespace glintmark
