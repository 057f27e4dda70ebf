// Ground truths of a bench run's views, and frames of single samples of them.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "host/experiment/bench_run.h"
#include "host/frame/ground_truth.h"

namespace glintmark {

/// The run's size at a width of at most `most_width_px`: errors need fewer pixels than times.
ImageSize truthSize(const BenchRun& run, int most_width_px);

/// The ground truth of a view with `spp` samples a pixel. Throws Interrupted after Ctrl-C.
ReplicatedTruth truthOf(BenchRun& run, const Scene& scene, const View& view,
                        const ShadingOptions& options, int spp,
                        std::shared_ptr<NormalTextures> textures = nullptr);

/// What the mean of R independent replicates may be off in a metric of frames, `metric(frame,
/// truth)`: the mean over replicates of how far frames are that differ from the mean by an error as
/// large as its own. A replicate is off by sqrt(R) times as much as their mean, and from the mean
/// by sqrt(R - 1) times. 0 of a single replicate. Sizes are equal.
double errorOfMean(const Image& mean, std::span<const Image> replicates,
                   const std::function<double(const Image&, const Image&)>& metric);

/// A frame by samples of the truth's kernel.
struct SampledFrame {
  Image mean;
  double shading_ms = 0;  // kernel events of all samples
};
/// `count` samples a pixel that no truth has used, after forgetting others.
SampledFrame sampleFrame(TruthRenderer& renderer, int count);

}  // namespace glintmark
