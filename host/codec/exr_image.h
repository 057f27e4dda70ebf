// EXR files that OpenImageIO refuses, by OpenEXR itself.
#pragma once
#include <memory>
#include <string>

#include "host/codec/image_codec.h"

namespace glintmark {

/// Opens an EXR file in which some flat part has channels that are stored for every n-th pixel
/// only, or luminance and chroma: of these OpenImageIO 2.4 reads those of whole chroma alone, 2.5
/// the others alone. Between samples, channels are interpolated linearly. Null for every other file
/// and for those that cannot be opened.
std::unique_ptr<StoredImage> openSampledExr(const std::string& path);

}  // namespace glintmark
