// The module that reads and writes image files.
#pragma once
#include <memory>
#include <string>

#include "host/codec/image_codec.h"
#include "host/report/picture/isolated_image.h"

namespace glintmark {

/// Loads the module at the first call, from the program's folder or from lib/glintmark beside it,
/// and keeps it. Throws Error naming the file and what stops it. Safe from any thread.
const ImageCodec& imageCodec();

/// Opens an image to be read, in a process of its own (openIsolated) unless this one has called
/// imageCodec() before: threads that the module may have then would be missing in another.
std::unique_ptr<StoredImage> openImage(const std::string& name, const ImageInMemory& memory,
                                       std::string& fault);

}  // namespace glintmark
