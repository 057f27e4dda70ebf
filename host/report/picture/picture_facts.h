// Pictures that say how they were made.
#pragma once
#include <filesystem>

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

}  // namespace glintmark
