// Ground truth of a view by supersampling on the device: kernels/truth.cl.
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "host/core/image.h"
#include "host/frame/frame_pass.h"
#include "host/parallel/ranks.h"

namespace glintmark {

/// Independent replicates of the samples' points, whose spread is the truth's standard error: the
/// points of one lie evenly, and beat what their spread says.
inline constexpr int kTruthReplicates = 8;
/// A replicate that no truth has, for sampled frames that are held against one.
inline constexpr std::uint32_t kRivalReplicate = kTruthReplicates;

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
  /// Forgets earlier samples; prepare() does so too.
  void clear() { pass_.clearResults(); }
  /// Adds samples `begin` and following of a replicate, `count` of them, to every pixel.
  FrameTimes addSamples(std::uint32_t begin, std::uint32_t count, std::uint32_t replicate = 0);
  /// The sum over the samples, laid out as FrameRenderer::readRadiance().
  Image readSum() const;
  /// The sum over `count`, the number of samples that were added.
  Image readMean(std::uint32_t count) const;
  const Camera& camera() const { return pass_.camera(); }

 private:
  FramePass pass_;
};

/// Samples that one launch adds.
struct TruthUnit {
  int replicate = 0;
  int begin = 0, count = 0;  // samples of the replicate
  int of_replicate = 0;      // samples that it has in all

  bool isLast() const { return begin + count == of_replicate; }
};
/// `spp` samples of so many pixels, replicate by replicate, in launches of some tenths of a second
/// on two cores. Throws Error for a number of samples that is not from 1 to 2^20.
std::vector<TruthUnit> truthUnits(int spp, double pixels);

struct TruthImages {
  Image mean;            // RGBA as readRadiance gives it
  Image standard_error;  // of the mean, RGB, from the spread of replicates; 0 for one sample
};

/// A truth and its replicates' means.
struct ReplicatedTruth {
  TruthImages images;
  std::vector<Image> replicates;
};

/// A truth that ranks share: its batches of samples are dealt out, each is summed from 0, and sums
/// are added in their order, so that every rank gets the bits that renderTruth() gives.
class SharedTruth {
 public:
  /// Of `spp` samples a pixel, like renderTruth().
  SharedTruth(const Ranks& ranks, int spp) : ranks_(ranks), spp_(spp) {}

  /// Of all ranks: renders those batches that `deal` gives to this one. `progress` may throw.
  /// Truths that are made with one deal before any is joined keep more ranks busy than one has
  /// batches.
  void make(TruthRenderer& renderer, RankDeal& deal, const std::function<void()>& progress);
  /// Of all ranks, after make(): the truth. Nothing can be joined after it.
  ReplicatedTruth join();

 private:
  const Ranks& ranks_;
  int spp_;
  std::vector<TruthUnit> units_;
  std::vector<int> makers_;  // of the units
  std::vector<Image> mine_;
  Image frame_;  // of the truth's size
};

/// Renders `view` with `spp` samples a pixel (1 to 2^20), shared out among kTruthReplicates
/// replicates (fewer than so many: one sample each), in batches. `progress` gets the samples done
/// after each, and an exception it throws ends the rendering; `replicates`, if given, their means.
/// Of `options` only size and lanes count.
TruthImages renderTruth(Device& device, const Scene& scene, const View& view,
                        const ShadingOptions& options, int spp,
                        const std::function<void(int done)>& progress = {}, int thread_count = 0,
                        std::shared_ptr<NormalTextures> textures = nullptr,
                        std::vector<Image>* replicates = nullptr);

}  // namespace glintmark
