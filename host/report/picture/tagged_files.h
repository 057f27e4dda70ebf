// What tags of image files say that OpenImageIO passes over.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace glintmark {

/// Why the pixels that OpenImageIO 2.4 gives for a TIFF file would not be the file's: one that does
/// not say how many bits a sample has means 1, and is read as if it had 8. Empty for others. `head`
/// is how the file begins. [TIFF 6.0, "BitsPerSample"]
std::string misreadingTiff(const std::filesystem::path& path, std::string_view head);

/// Of a WebP file, else the defaults.
struct WebpFacts {
  bool has_alpha = false;
  int orientation = 1;  // by its Exif chunk: one of the eight of TIFF and Exif
};
/// Reads a WebP file that says it has Exif to its end. [Google, "WebP Container Specification"]
WebpFacts webpFacts(const std::filesystem::path& path, std::string_view head);

}  // namespace glintmark
