// Image files.
#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>

#include "host/core/image.h"

namespace glintmark {

/// Writes a float EXR (ZIP compressed) of any channel count. Channel names come from the image;
/// without them Y, RGB or RGBA for 1, 3 or 4 channels. Throws Error naming the file; no half file
/// stays behind.
void writeExr(const Image& image, const std::filesystem::path& path);

/// Writes an 8-bit PNG of 1, 3 or 4 channels. `image` holds display values, sRGB encoded, which are
/// clamped to [0, 1] and rounded; NaN becomes 0. Throws Error like writeExr.
void writePng(const Image& image, const std::filesystem::path& path);

/// Reads all channels of an image file's first part with their names. Values come as they are
/// stored, whole numbers scaled to [0, 1] and still sRGB encoded; the picture is the display
/// window, turned as its orientation says. Throws Error naming the file: what a reader only warns
/// of is an error, sizes are checked before memory is taken.
Image readImage(const std::filesystem::path& path);

/// Red, green and blue of a picture; a grey one has three alike. `FILE#LAYER` names a layer or a
/// part of an EXR file; without a name it is the one that colours are in. Throws Error like
/// readImage, and listing the layers if none or several may be meant.
Image readColours(const std::filesystem::path& path);

/// What a normal map is made of: three channels, two of normals, or one of heights, without alpha.
/// Of several layers it is the one whose name or whose unit vectors say so. Throws Error like
/// readColours.
Image readNormals(const std::filesystem::path& path);

/// Texels each way of what readNormals gives, by the file's head alone. Throws Error like
/// readImage.
glm::ivec2 normalsSize(const std::filesystem::path& path);

/// readNormals of a file in memory; `name` is for messages.
Image decodeNormals(std::string_view bytes, const std::string& name);

/// The lower-case extension of `path` if it is one of `.exr` and `.png`; throws Error otherwise.
std::string requireImageExtension(const std::filesystem::path& path);

}  // namespace glintmark
