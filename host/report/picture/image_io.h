// Image files. With text_coverage.cpp the only code that includes OpenImageIO.
#pragma once
#include <filesystem>

#include "host/core/image.h"

namespace glintmark {

/// Writes a float EXR (ZIP compressed) of any channel count. Channel names come from the image;
/// without them Y, RGB or RGBA for 1, 3 or 4 channels. Throws Error naming the file; no half file
/// stays behind.
void writeExr(const Image& image, const std::filesystem::path& path);

/// Writes an 8-bit PNG of 1, 3 or 4 channels. `image` holds display values, sRGB encoded, which are
/// clamped to [0, 1] and rounded; NaN becomes 0. Throws Error like writeExr.
void writePng(const Image& image, const std::filesystem::path& path);

/// Reads an EXR, HDR or PNG with its channel names. Values come as they are stored, PNG scaled to
/// [0, 1] and still sRGB encoded. Throws Error naming the file.
Image readImage(const std::filesystem::path& path);

/// The lower-case extension of `path` if it is one of `.exr` and `.png`; throws Error otherwise.
std::string requireImageExtension(const std::filesystem::path& path);

}  // namespace glintmark
