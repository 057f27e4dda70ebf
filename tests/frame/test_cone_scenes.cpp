// Shipped scenes under cones of light, smooth lobes alone: no pixel leaves what point lights all
// over the cones bring.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "host/frame/ground_truth.h"
#include "host/scene/load_scene.h"
#include "tests/frame/frame_test.h"

namespace glintmark {
namespace {

class ConeScenes : public testing::TestWithParam<std::string> {};

// The truth of a pixel is a mean over its area and over the lights, the frame's is its centre. What
// the quadrature leaves beyond 20 degrees, and what samples leave, in standard errors.
constexpr double kConeTolerance = 0.2, kStandardErrors = 6;

TEST_P(ConeScenes, NoPixelIsBrighterThanTheTruth) {
  SceneRequest request;
  request.scene = GetParam();
  Scene scene = loadScene(request);
  // Of further bounces the truth knows nothing.
  for (Material& material : scene.materials) material.compensation = Compensation::kOff;
  ShadingOptions options = smallOptions();
  options.width_px = 96;
  options.height_px = 54;
  options.lanes = 4;
  options.glints = false;
  FrameRenderer renderer(device(), scene, scene.views[0], options, 2);
  renderer.prepare();
  renderer.shade();
  const Image frame = renderer.readRadiance();
  const TruthImages truth = renderTruth(device(), scene, scene.views[0], options, 256, {}, 2);
  std::vector<float> bright;
  for (std::size_t i = 0; i < truth.mean.pixels.size(); i += 4)
    if (truth.mean.pixels[i + 3] > 0) bright.push_back(truth.mean.pixels[i]);
  ASSERT_FALSE(bright.empty());
  const auto top = bright.begin() + static_cast<std::ptrdiff_t>(bright.size() * 99 / 100);
  std::nth_element(bright.begin(), top, bright.end());
  const double highlight = *top;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    if (i % 4 == 3) continue;
    ASSERT_TRUE(std::isfinite(frame.pixels[i]));
    const double want = truth.mean.pixels[i];
    const double noise = kStandardErrors * truth.standard_error.pixels[i / 4 * 3 + i % 4];
    EXPECT_LE(frame.pixels[i], want + noise + kConeTolerance * std::max(want, highlight))
        << "pixel (" << i / 4 % 96 << ", " << i / 4 / 96 << ")";
  }
}

INSTANTIATE_TEST_SUITE_P(All, ConeScenes,
                         testing::Values("sand", "rough_metal", "glitter", "hero", "brushed",
                                         "circular_brushing", "car", "snow", "screen_plane"),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace glintmark
