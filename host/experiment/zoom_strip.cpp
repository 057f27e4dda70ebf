#include "host/experiment/zoom_strip.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "host/core/error.h"
#include "host/report/picture/picture_strip.h"
#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

constexpr int kPerOctave = 2;
constexpr int kPerRow = 7;

View zoomed(View view, double octaves) {
  const double half = view.fov_y_deg * std::numbers::pi / 360;
  view.fov_y_deg = std::atan(std::tan(half) * std::exp2(-octaves)) * 360 / std::numbers::pi;
  return view;
}

Image blank(const Image& like) {
  Image image(like.width, like.height, 3);
  std::ranges::fill(image.pixels, 1.0f);
  return image;
}

}  // namespace

Image zoomStrip(Device& device, const Scene& scene, const View& view, const ShadingOptions& shading,
                int octaves, double exposure, int thread_count,
                const std::function<void(const Image& radiance)>& judge) {
  if (octaves < 1 || octaves > kMostZoomOctaves)
    throw Error(
        fmt::format("a zoom over {} octaves is not from 1 to {}", octaves, kMostZoomOctaves));
  std::vector<Image> rows;
  std::vector<std::pair<std::string, Image>> row;
  for (int k = 0; k <= octaves * kPerOctave; ++k) {
    const double zoom = static_cast<double>(k) / kPerOctave;
    ShadingOptions options = shading;
    options.may_show_nothing = k > 0;  // between meshes, perhaps
    FrameRenderer renderer(device, scene, zoomed(view, zoom), options, thread_count);
    renderer.prepare();
    renderer.shade();
    const Image radiance = renderer.readRadiance();
    judge(radiance);
    row.emplace_back(fmt::format("2^{:g}", zoom), toneMap(radiance, {.exposure = exposure}));
    if (row.size() == kPerRow) rows.push_back(pictureStrip(std::exchange(row, {})));
  }
  if (!row.empty()) {
    while (row.size() < kPerRow) row.emplace_back("", blank(row.front().second));
    rows.push_back(pictureStrip(row));
  }
  return pictureColumn(rows);
}

}  // namespace glintmark
