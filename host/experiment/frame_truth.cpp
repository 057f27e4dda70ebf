#include "host/experiment/frame_truth.h"

#include <algorithm>
#include <cmath>

#include "host/experiment/frame_timing.h"

namespace glintmark {

ImageSize truthSize(const BenchRun& run, int most_width_px) {
  const ImageSize full = run.size();
  ImageSize size;
  size.width_px = std::min(full.width_px, most_width_px);
  size.height_px = std::max(1, full.height_px * size.width_px / full.width_px);
  return size;
}

ReplicatedTruth truthOf(BenchRun& run, const Scene& scene, const View& view,
                        const ShadingOptions& options, int spp,
                        std::shared_ptr<NormalTextures> textures) {
  ReplicatedTruth truth;
  truth.images = renderTruth(
      run.device(), scene, view, options, spp, [](int) { stopIfInterrupted(); }, run.threads(),
      std::move(textures), &truth.replicates);
  return truth;
}

double errorOfMean(const Image& mean, std::span<const Image> replicates,
                   const std::function<double(const Image&, const Image&)>& metric) {
  const std::size_t count = replicates.size();
  if (count < 2) return 0;
  const auto share = static_cast<float>(1 / std::sqrt(static_cast<double>(count - 1)));
  double sum = 0;
  for (const Image& replicate : replicates) {
    Image off = mean;
    for (std::size_t i = 0; i < off.pixels.size(); ++i)
      off.pixels[i] += share * (replicate.pixels[i] - mean.pixels[i]);
    sum += metric(off, mean);
  }
  return sum / static_cast<double>(count);
}

SampledFrame sampleFrame(TruthRenderer& renderer, int count) {
  renderer.prepare();
  const FrameTimes times =
      renderer.addSamples(0, static_cast<std::uint32_t>(count), kRivalReplicate);
  return {renderer.readMean(static_cast<std::uint32_t>(count)), times.shading_event_ns * kMsPerNs};
}

}  // namespace glintmark
