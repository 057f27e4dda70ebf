// Ground truths of a bench run's views, and frames of single samples of them.
#pragma once
#include <cstdint>
#include <memory>

#include "host/experiment/bench_run.h"
#include "host/frame/ground_truth.h"

namespace glintmark {

/// The run's size at a width of at most `most_width_px`: errors need fewer pixels than times.
ImageSize truthSize(const BenchRun& run, int most_width_px);

/// The ground truth of a view with `spp` samples a pixel. Throws Interrupted after Ctrl-C.
TruthImages truthOf(BenchRun& run, const Scene& scene, const View& view,
                    const ShadingOptions& options, int spp,
                    std::shared_ptr<NormalTextures> textures = nullptr);

/// The truth with every pixel brighter by its standard error.
Image oneErrorOff(const TruthImages& truth);

/// A frame by samples of the truth's kernel.
struct SampledFrame {
  Image mean;
  double shading_ms = 0;  // kernel events of all samples
};
/// `count` samples a pixel from number `begin` on, after forgetting others.
SampledFrame sampleFrame(TruthRenderer& renderer, int begin, int count);

}  // namespace glintmark
