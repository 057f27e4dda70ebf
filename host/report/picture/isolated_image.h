// Image files read in a process of their own: libraries of image formats crash on damaged ones.
#pragma once
#include <memory>
#include <string>
#include <string_view>

#include "host/codec/image_codec.h"

namespace glintmark {

/// An image file, or one in memory.
struct ImageInMemory {
  std::string format;      // "png", as the codec calls it; empty: the file of that name is meant
  std::string_view bytes;  // live as long as what was opened
};

/// Opens an image like the codec does; `name` is the file's, or for messages. Whatever is asked of
/// it is worked out by a forked process, which ends with the image. Throws Error where that process
/// ends by a fault or is stuck.
std::unique_ptr<StoredImage> openIsolated(const ImageCodec& codec, const std::string& name,
                                          const ImageInMemory& memory, std::string& fault);

}  // namespace glintmark
