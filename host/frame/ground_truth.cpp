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

// Mean and spread of replicates' means, which weigh as much as the samples they have. West,
// "Updating Mean and Variance Estimates: an Improved Method", 1979.
class TruthSpread {
 public:
  TruthSpread(int width_px, int height_px)
      : images_{Image(width_px, height_px, 4), Image(width_px, height_px, 3)} {}

  void add(const Image& replicate, int samples) {
    weight_ += samples;
    ++count_;
    const float share = static_cast<float>(samples) / static_cast<float>(weight_);
    if (count_ == 1) images_.mean.channel_names = replicate.channel_names;
    for (std::size_t i = 0; i < replicate.pixels.size() / 4; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        float& mean = images_.mean.pixels[4 * i + c];
        const float before = replicate.pixels[4 * i + c] - mean;
        mean += share * before;
        images_.standard_error.pixels[3 * i + c] +=
            static_cast<float>(samples) * before * (replicate.pixels[4 * i + c] - mean);
      }
      images_.mean.pixels[4 * i + 3] = replicate.pixels[4 * i + 3];
    }
  }

  // Squares become errors; nothing can be added after it.
  TruthImages take() {
    const auto freedom = static_cast<float>(weight_) * static_cast<float>(std::max(1, count_ - 1));
    for (float& squares : images_.standard_error.pixels)
      squares = std::sqrt(std::max(0.0f, squares) / freedom);
    return std::move(images_);
  }

 private:
  TruthImages images_;
  int weight_ = 0, count_ = 0;
};

}  // namespace

TruthRenderer::TruthRenderer(Device& device, const Scene& scene, const View& view,
                             const ShadingOptions& options, int thread_count,
                             std::shared_ptr<NormalTextures> textures)
    : pass_(kTruthPass, device, scene, view, options, thread_count, std::move(textures)) {}

FrameTimes TruthRenderer::addSamples(std::uint32_t begin, std::uint32_t count,
                                     std::uint32_t replicate) {
  const TraceScope scope("frame", "truth samples");
  pass_.setNumber("replicate", replicate);
  pass_.setNumber("sample_begin", begin);
  pass_.setNumber("sample_count", count);
  return pass_.launch();
}

Image TruthRenderer::readSum() const {
  double readback_ns = 0;
  return readPlanes(pass_, readback_ns);
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
                        std::shared_ptr<NormalTextures> textures, std::vector<Image>* replicates) {
  if (spp < 1 || spp > kMostSpp)
    throw Error(fmt::format("{} samples a pixel are not from 1 to {}", spp, kMostSpp));
  TruthRenderer renderer(device, scene, view, options, thread_count, std::move(textures));
  renderer.prepare();
  const Camera& camera = renderer.camera();
  const double pixels = static_cast<double>(camera.width_px) * camera.height_px;
  const int batch = std::max(1, static_cast<int>(kBatchSamples / pixels));
  const int count = std::min(spp, kTruthReplicates);
  TruthSpread spread(camera.width_px, camera.height_px);
  int done = 0;
  for (int replicate = 0; replicate < count; ++replicate) {
    const int samples = spp / count + (replicate < spp % count ? 1 : 0);
    renderer.clear();
    for (int begin = 0; begin < samples; begin += batch) {
      const int some = std::min(batch, samples - begin);
      renderer.addSamples(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(some),
                          static_cast<std::uint32_t>(replicate));
      done += some;
      if (progress) progress(done);
    }
    Image mean = renderer.readMean(static_cast<std::uint32_t>(samples));
    spread.add(mean, samples);
    if (replicates != nullptr) replicates->push_back(std::move(mean));
  }
  return spread.take();
}

}  // namespace glintmark
