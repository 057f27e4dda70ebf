#include "host/report/picture/image_io.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/report/picture/load_codec.h"
#include "host/report/picture/picture_facts.h"
#include "host/report/record/run_info.h"

namespace glintmark {
namespace {

std::string lowerExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::vector<std::string> channelNames(const Image& image, const std::filesystem::path& path) {
  if (!image.channel_names.empty()) return image.channel_names;
  if (image.channels == 1) return {"Y"};
  if (image.channels == 3) return {"R", "G", "B"};
  if (image.channels == 4) return {"R", "G", "B", "A"};
  throw Error(fmt::format("cannot write {}: an image of {} channels needs channel names",
                          path.string(), image.channels));
}

void requireConsistent(const Image& image, const std::filesystem::path& path) {
  const std::size_t expected =
      static_cast<std::size_t>(image.width) * image.height * image.channels;
  const bool names_fit = image.channel_names.empty() ||
                         image.channel_names.size() == static_cast<std::size_t>(image.channels);
  if (image.width < 1 || image.height < 1 || image.channels < 1 ||
      image.pixels.size() != expected || !names_fit) {
    throw Error(
        fmt::format("cannot write {}: the image of {}x{} pixels and {} channels is empty "
                    "or inconsistent",
                    path.string(), image.width, image.height, image.channels));
  }
}

void encodeFile(PixelBlock block, const std::filesystem::path& path) {
  // OpenImageIO dates an EXR with now, unless it is told otherwise.
  if (const std::optional<std::time_t> date = sourceDate())
    block.facts.emplace_back("DateTime", fmt::format("{:%Y:%m:%d %H:%M:%S}", fmt::gmtime(*date)));
  std::string fault;
  const std::vector<unsigned char> bytes = imageCodec().encode(block, fault);
  if (bytes.empty()) throw Error(fmt::format("cannot write {}: {}", path.string(), fault));
  writeFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

std::string requireImageExtension(const std::filesystem::path& path) {
  std::string extension = lowerExtension(path);
  if (extension != ".exr" && extension != ".png") {
    throw Error(fmt::format("cannot write '{}': the name must end in .exr or .png", path.string()));
  }
  return extension;
}

void writeExr(const Image& image, const std::filesystem::path& path) {
  writeExr(image, path, {});
}

void writePng(const Image& image, const std::filesystem::path& path) {
  writePng(image, path, {});
}

void writeExr(const Image& image, const std::filesystem::path& path, const PictureFacts& facts) {
  requireConsistent(image, path);
  encodeFile({.width = image.width,
              .height = image.height,
              .channel_names = channelNames(image, path),
              .floats = image.pixels,
              .facts = facts},
             path);
}

void writeExr(const ImageBands& image, const std::filesystem::path& path,
              const PictureFacts& facts) {
  // Whole blocks of ZIP's 16 rows, several for each thread that packs them.
  constexpr std::size_t kBlockRows = 16;
  const std::size_t row_bytes =
      static_cast<std::size_t>(image.width) * image.channels.size() * sizeof(float);
  const std::size_t blocks = std::max<std::size_t>(
      1, image.band_bytes / (std::max<std::size_t>(1, row_bytes) * kBlockRows));
  Image band;
  encodeFile({.width = image.width,
              .height = image.height,
              .channel_names = image.channels,
              .band =
                  [&](int first_row, int rows) {
                    band = image.band(first_row, rows);
                    return std::span<const float>(band.pixels);
                  },
              .band_rows = static_cast<int>(std::min<std::size_t>(
                  blocks * kBlockRows, static_cast<std::size_t>(image.height))),
              .facts = facts},
             path);
}

void writePng(const Image& image, const std::filesystem::path& path, const PictureFacts& facts) {
  requireConsistent(image, path);
  if (image.channels == 2 || image.channels > 4) {
    throw Error(fmt::format("cannot write {}: a PNG holds 1, 3 or 4 channels, not {}",
                            path.string(), image.channels));
  }
  std::vector<std::uint8_t> bytes(image.pixels.size());
  std::ranges::transform(image.pixels, bytes.begin(), [](float value) {
    // The comparison is false for NaN, which becomes 0.
    const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
    return static_cast<std::uint8_t>(std::lround(clamped * 255.0f));
  });
  encodeFile({.width = image.width,
              .height = image.height,
              .channel_names = channelNames(image, path),
              .bytes = bytes,
              .facts = facts},
             path);
}

}  // namespace glintmark
