// Pictures that say how they were made.
#pragma once
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host/codec/image_codec.h"
#include "host/core/image.h"
#include "host/report/record/record.h"

namespace glintmark {

/// What the files of a run's pictures say: "glintmark:version", "glintmark:command",
/// "glintmark:device" and "glintmark:inputs", the hash of kernels, tables, scene and mesh. The
/// date is the codec's: with $SOURCE_DATE_EPOCH the same command makes the same bytes.
PictureFacts factsOf(const RunInfo& run);

/// As writeExr() and writePng() of image_io.h; the facts are attributes of the EXR, texts of the
/// PNG.
void writeExr(const Image& image, const std::filesystem::path& path, const PictureFacts& facts);
void writePng(const Image& image, const std::filesystem::path& path, const PictureFacts& facts);

/// An image that is made as it is written, one band of rows after the other.
struct ImageBands {
  int width = 0, height = 0;
  std::vector<std::string> channels;
  std::function<Image(int first_row, int rows)> band;  // of those channels
  std::size_t band_bytes = std::size_t{128} << 20;     // about; at least 16 rows
};
void writeExr(const ImageBands& image, const std::filesystem::path& path,
              const PictureFacts& facts);

}  // namespace glintmark
