#include "host/frame/ground_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"
#include "host/core/trace.h"
#include "host/frame/frame_readback.h"

namespace glintmark {
namespace {

constexpr int kMostSpp = 1 << 20;
// Samples of all pixels together in one launch: some tenths of a second on two cores.
constexpr double kBatchSamples = 8e6;

}  // namespace

TruthRenderer::TruthRenderer(Device& device, const Scene& scene, const View& view,
                             const ShadingOptions& options, int thread_count,
                             std::shared_ptr<NormalTextures> textures)
    : pass_(kTruthPass, device, scene, view, options, thread_count, std::move(textures)) {}

FrameTimes TruthRenderer::addSamples(std::uint32_t begin, std::uint32_t count) {
  const TraceScope scope("frame", "truth samples");
  pass_.setNumber("sample_begin", begin);
  pass_.setNumber("sample_count", count);
  return pass_.launch();
}

Image TruthRenderer::readSum() const {
  double readback_ns = 0;
  return readPlanes(pass_, 0, readback_ns);
}

Image TruthRenderer::readSquares() const {
  double readback_ns = 0;
  return readPlanes(pass_, 3, readback_ns);
}

Image TruthRenderer::readMean(std::uint32_t count) const {
  Image image = readSum();
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    if (i % 4 != 3) image.pixels[i] /= static_cast<float>(count);
  return image;
}

TruthImages renderTruth(Device& device, const Scene& scene, const View& view,
                        const ShadingOptions& options, int spp,
                        const std::function<void(int done)>& progress, int thread_count,
                        std::shared_ptr<NormalTextures> textures) {
  if (spp < 1 || spp > kMostSpp)
    throw Error(fmt::format("{} samples a pixel are not from 1 to {}", spp, kMostSpp));
  TruthRenderer renderer(device, scene, view, options, thread_count, std::move(textures));
  renderer.prepare();
  const Camera& camera = renderer.camera();
  const double pixels = static_cast<double>(camera.width_px) * camera.height_px;
  const int batch = std::max(1, static_cast<int>(kBatchSamples / pixels));
  for (int done = 0; done < spp;) {
    const int count = std::min(batch, spp - done);
    renderer.addSamples(static_cast<std::uint32_t>(done), static_cast<std::uint32_t>(count));
    done += count;
    if (progress) progress(done);
  }

  TruthImages truth{renderer.readSum(), Image(camera.width_px, camera.height_px, 3)};
  const Image squares = renderer.readSquares();
  const auto n = static_cast<float>(spp);
  for (std::size_t i = 0; i < squares.pixels.size() / 4; ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      float& mean = truth.mean.pixels[4 * i + c];
      mean /= n;
      const float variance = std::max(0.0f, squares.pixels[4 * i + c] / n - mean * mean);
      truth.standard_error.pixels[3 * i + c] = spp > 1 ? std::sqrt(variance / (n - 1)) : 0.0f;
    }
  return truth;
}

}  // namespace glintmark
