// Ground truth of a view by supersampling on the device: kernels/truth.cl.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>

#include "host/core/image.h"
#include "host/frame/frame_pass.h"

namespace glintmark {

/// The paper's rays per pixel. [TAN05] Sect. 5
inline constexpr int kPaperTruthSpp = 16;

/// Sums samples of a view. No effect's own kernel functions are called: lights are looked up, and
/// normals read, at each sample's place.
class TruthRenderer {
 public:
  /// Of `options` only size and lanes count. `textures` may be shared with other renderers of the
  /// device.
  TruthRenderer(Device& device, const Scene& scene, const View& view, const ShadingOptions& options,
                int thread_count = 0, std::shared_ptr<NormalTextures> textures = nullptr);

  /// Rasterizes, uploads and forgets earlier samples; must come before addSamples().
  FrameTimes prepare() { return pass_.prepare(); }
  /// Adds samples `begin` and following, `count` of them, to every pixel.
  FrameTimes addSamples(std::uint32_t begin, std::uint32_t count);
  /// Sums over the samples, and over their squares, laid out as FrameRenderer::readRadiance().
  Image readSum() const;
  Image readSquares() const;
  /// The sum over `count`, the number of samples that were added.
  Image readMean(std::uint32_t count) const;
  const Camera& camera() const { return pass_.camera(); }

 private:
  FramePass pass_;
};

struct TruthImages {
  Image mean;            // RGBA as readRadiance gives it
  Image standard_error;  // of the mean, RGB; from the samples' spread, which evenly spread samples
                         // beat, so it is an upper bound
};

/// Renders `view` with `spp` samples a pixel (1 to 2^20), in batches; `progress` gets the samples
/// done after each, and an exception it throws ends the rendering. Of `options` only size and lanes
/// count.
TruthImages renderTruth(Device& device, const Scene& scene, const View& view,
                        const ShadingOptions& options, int spp,
                        const std::function<void(int done)>& progress = {}, int thread_count = 0,
                        std::shared_ptr<NormalTextures> textures = nullptr);

}  // namespace glintmark
