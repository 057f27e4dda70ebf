// Ground truth of a view by supersampling on the device: kernels/truth.cl.
#pragma once
#include <functional>

#include "host/core/image.h"
#include "host/frame/frame_renderer.h"

namespace glintmark {

/// The paper's rays per pixel. [TAN05] Sect. 5
inline constexpr int kPaperTruthSpp = 16;

struct TruthImages {
  Image mean;            // RGBA as readRadiance gives it
  Image standard_error;  // of the mean, RGB; from the samples' spread, which evenly spread samples
                         // beat, so it is an upper bound
};

/// Renders `view` with `spp` samples a pixel (1 to 2^20), in batches; `progress` gets the samples
/// done after each, and an exception it throws ends the rendering. Of `options` only size and lanes
/// count.
TruthImages renderTruth(Device& device, const Scene& scene, const View& view,
                        ShadingOptions options, int spp,
                        const std::function<void(int done)>& progress = {}, int thread_count = 0,
                        std::shared_ptr<NormalTextures> textures = nullptr);

}  // namespace glintmark
