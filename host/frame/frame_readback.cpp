#include "host/frame/frame_readback.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <span>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr std::uint32_t kLimitedBit = 0x80000000u;

// A driver that says that all work-items ran when none did, or half of them, is caught here.
template <typename Word>
void requireWritten(const FramePass& pass, const PixelList& list, std::span<const Word> words) {
  const auto own = words.subspan(list.offset, list.count);
  const auto unwritten = std::ranges::count_if(
      own, [](Word word) { return std::bit_cast<std::uint32_t>(word) == kUnwrittenWord; });
  if (unwritten == 0) return;
  throw Error(
      fmt::format(
          "kernel '{}' left {} of {} pixels unwritten on '{}', whose driver says that it ran",
          pass.kernelName(), unwritten, list.count, pass.deviceName()),
      kExitNoDevice);
}

// Visits the count of every pixel of glint materials.
template <typename Visit>
void forEachCount(const FramePass& pass, const Visit& visit) {
  if (!pass.options().count_cells)
    throw Error("cells were not counted: set ShadingOptions::count_cells before shading");
  for (const FramePass::Band& band : pass.bands()) {
    std::vector<std::uint32_t> words(2 * band.planes.stride);  // visited, paid for
    if (!words.empty()) band.counts.read(words.data(), words.size() * 4);
    for (const FramePass::Launch& launch : band.launches) {
      if (!launch.config.count_cells) continue;
      const std::uint32_t end = launch.list.offset + launch.list.count;
      requireWritten(pass, launch.list, std::span<const std::uint32_t>(words));
      for (std::uint32_t i = launch.list.offset; i < end; ++i)
        visit(band, i, words[i], words[band.planes.stride + i]);
    }
  }
}

}  // namespace

Image readPlanes(const FramePass& pass, double& readback_ns) {
  const Camera& camera = pass.camera();
  Image image(camera.width_px, camera.height_px, 4);
  image.channel_names = {"R", "G", "B", "A"};
  for (const FramePass::Band& band : pass.bands()) {
    const PixelPlanes& planes = band.planes;
    std::vector<float> words(planes.stride * 3);
    if (!words.empty()) readback_ns += band.results.read(words.data(), words.size() * 4);
    const auto pixels = planes.plane(Plane::kPixel);
    for (const PixelList& list : planes.lists) {
      requireWritten(pass, list, std::span<const float>(words));
      tbb::parallel_for(list.offset, list.offset + list.count, [&](std::uint32_t i) {
        const auto out = image.at(static_cast<int>(pixels[i] & 0xFFFFu),
                                  band.top_px + static_cast<int>(pixels[i] >> 16));
        for (std::size_t c = 0; c < 3; ++c) out[c] = words[c * planes.stride + i];
        out[3] = 1.0f;
      });
    }
  }
  return image;
}

Image readCellImage(const FramePass& pass) {
  Image image(pass.camera().width_px, pass.camera().height_px, 1);
  image.channel_names = {"cells"};
  std::ranges::fill(image.pixels, -1.0f);
  forEachCount(pass, [&](const FramePass::Band& band, std::uint32_t entry, std::uint32_t word,
                         std::uint32_t) {
    const std::uint32_t pixel = band.planes.plane(Plane::kPixel)[entry];
    image.at(static_cast<int>(pixel & 0xFFFFu), band.top_px + static_cast<int>(pixel >> 16))[0] =
        static_cast<float>(word & ~kLimitedBit);
  });
  return image;
}

CellCounts countCells(const FramePass& pass) {
  CellCounts result;
  std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
  double total = 0, paid = 0;
  forEachCount(pass, [&](const FramePass::Band&, std::uint32_t, std::uint32_t word,
                         std::uint32_t paid_cells) {
    paid += paid_cells;
    const std::uint32_t cells = word & ~kLimitedBit;
    if (cells == 0) return;
    least = std::min(least, cells);
    result.max = std::max(result.max, cells);
    total += cells;
    ++result.glint_px;
    if (word & kLimitedBit) ++result.guard_hits;
  });
  result.min = result.glint_px > 0 ? least : 0;
  if (result.glint_px == 0) return result;
  result.mean = total / static_cast<double>(result.glint_px);
  result.paid_mean = paid / static_cast<double>(result.glint_px);
  return result;
}

}  // namespace glintmark
