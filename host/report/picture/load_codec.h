// The module that reads and writes image files.
#pragma once
#include "host/codec/image_codec.h"

namespace glintmark {

/// Loads the module at the first call, from the program's folder or from lib/glintmark beside it,
/// and keeps it. Throws Error naming the file and what stops it. Safe from any thread.
const ImageCodec& imageCodec();

}  // namespace glintmark
