#include "host/experiment/frame_truth.h"

#include <algorithm>

#include "host/experiment/frame_timing.h"

namespace glintmark {

ImageSize truthSize(const BenchRun& run, int most_width_px) {
  const ImageSize full = run.size();
  ImageSize size;
  size.width_px = std::min(full.width_px, most_width_px);
  size.height_px = std::max(1, full.height_px * size.width_px / full.width_px);
  return size;
}

TruthImages truthOf(BenchRun& run, const Scene& scene, const View& view,
                    const ShadingOptions& options, int spp,
                    std::shared_ptr<NormalTextures> textures) {
  return renderTruth(
      run.device(), scene, view, options, spp, [](int) { stopIfInterrupted(); }, run.threads(),
      std::move(textures));
}

Image oneErrorOff(const TruthImages& truth) {
  Image off = truth.mean;
  for (std::size_t i = 0; i < off.pixels.size() / 4; ++i)
    for (std::size_t c = 0; c < 3; ++c)
      off.pixels[4 * i + c] += truth.standard_error.pixels[3 * i + c];
  return off;
}

SampledFrame sampleFrame(TruthRenderer& renderer, int begin, int count) {
  renderer.prepare();
  const FrameTimes times =
      renderer.addSamples(static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(count));
  return {renderer.readMean(static_cast<std::uint32_t>(count)), times.shading_event_ns * kMsPerNs};
}

}  // namespace glintmark
