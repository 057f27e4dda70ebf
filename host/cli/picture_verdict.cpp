#include "host/cli/picture_verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "host/report/metrics.h"

namespace glintmark {
namespace {

// Pixels of which `is_so(channels)` holds.
template <typename Predicate>
std::size_t countPixels(const Image& image, Predicate is_so) {
  std::size_t count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) count += is_so(image.at(x, y));
  return count;
}

}  // namespace

PictureFault judgePicture(const Image& radiance, const Scene& scene, const View& view,
                          bool shows_environment) {
  const std::size_t broken = countPixels(radiance, [](const auto& channels) {
    return !std::ranges::all_of(channels, [](float value) { return std::isfinite(value); });
  });
  if (broken > 0) {
    fmt::print(stderr,
               "glintmark: {} pixels of the picture are not finite: some value of the scene is too "
               "large for single precision\n",
               broken);
    return PictureFault::kNotFinite;
  }
  if (countPixels(radiance, [](const auto& channels) { return channels[3] != 0; }) == 0) {
    fmt::print(stderr, "note: view {} of {} covers no pixel, so the picture is {}\n", view.name,
               scene.name, shows_environment ? "the environment alone" : "empty");
    return shows_environment ? PictureFault::kNone : PictureFault::kEmpty;
  }
  if (hasLight(radiance)) return PictureFault::kNone;
  const bool shows_sky = shows_environment && countPixels(radiance, [](const auto& channels) {
                                                return channels[3] == 0;
                                              }) > 0;
  fmt::print(stderr, "note: nothing that view {} of {} shows reflects light to it, so {} black\n",
             view.name, scene.name, shows_sky ? "its meshes are" : "the picture is");
  return shows_sky ? PictureFault::kNone : PictureFault::kBlack;
}

}  // namespace glintmark
