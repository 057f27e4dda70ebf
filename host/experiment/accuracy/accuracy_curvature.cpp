// Filters of what the mesh's own curvature does below a pixel, and more pixels as their rival.
// [KHPL16], [TK19], [TK21]
#include <fmt/format.h>

#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/accuracy/accuracy_truth.h"
#include "host/experiment/accuracy/knob_settings.h"
#include "host/experiment/shifted_view.h"

namespace glintmark {
namespace {

// Samples along a pixel's side: of the truth, whose samples are pixels of a larger picture; of the
// rivals.
constexpr int kTruthSide = 16;
constexpr int kSides[] = {2, 4};
constexpr SampledTruthSettings kCurvatureTruth = {
    PrincipalMetric::kRelMse, 320, kTruthSide* kTruthSide, static_cast<int>(std::size(kShifts_px))};

std::vector<AccuracySetting> curvatureSettings() {
  KnobSettings knobs("curvature");
  std::vector<AccuracySetting> all;
  knobs.moveRestTo(all);
  for (const int side : kSides)
    all.push_back({fmt::format("pixels_across={}", side),
                   [side](ShadingOptions& o) {
                     o.width_px *= side;
                     o.height_px *= side;
                   },
                   kAccuracyRival});
  return all;
}

// Means over the samples (x, y) of each pixel, `side` along its side, for which takes(x, y) holds;
// covered where all samples are.
template <typename Takes>
Image meanOfSamples(const Image& samples, int side, const Takes& takes) {
  Image mean(samples.width / side, samples.height / side, 4);
  mean.channel_names = samples.channel_names;
  for (int y = 0; y < mean.height; ++y)
    for (int x = 0; x < mean.width; ++x) {
      const auto pixel = mean.at(x, y);
      int count = 0;
      bool covered = true;
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
          const auto sample = samples.at(x * side + i, y * side + j);
          covered = covered && sample[3] > 0;
          if (!takes(i, j)) continue;
          ++count;
          for (std::size_t c = 0; c < 3; ++c) pixel[c] += sample[c];
        }
      for (std::size_t c = 0; c < 3; ++c) pixel[c] /= static_cast<float>(count);
      pixel[3] = covered ? 1.0f : 0.0f;
    }
  return mean;
}

// The truth's kernel takes a mesh's frame as one over a pixel; here every sample is a pixel of its
// own, rasterized.
class CurvatureSweep : public SampledSweep {
 public:
  using SampledSweep::SampledSweep;

  // Each rank renders those of its own cases.
  void prepareTruths() override {}

 protected:
  ReplicatedTruth makeTruth(const AccuracyStage& stage, const View& view) const override {
    ShadingOptions options = truthOptions(stage);
    options.width_px *= kTruthSide;
    options.height_px *= kTruthSide;
    const Image samples = stage.renderer(options, &view)->readRadiance();
    ReplicatedTruth truth;
    truth.images.mean = meanOfSamples(samples, kTruthSide, [](int, int) { return true; });
    // Lattices of one sample in eight, all alike but for their place.
    for (int replicate = 0; replicate < kTruthReplicates; ++replicate)
      truth.replicates.push_back(meanOfSamples(samples, kTruthSide, [&](int i, int j) {
        return (i + 3 * j) % kTruthReplicates == replicate;
      }));
    return truth;
  }

  Image image(const AccuracyStage& stage, const View& view,
              const AccuracySetting& setting) const override {
    ShadingOptions options = truthOptions(stage);
    const int width_px = options.width_px;
    if (setting.apply) setting.apply(options);
    const Image frame = stage.renderer(options, &view)->readRadiance();
    if (options.width_px == width_px) return frame;
    return meanOfSamples(frame, options.width_px / width_px, [](int, int) { return true; });
  }
};

}  // namespace

AccuracyKind curvatureAccuracy() {
  return {"curvature",
          knobsOf(curvatureSettings()),
          {"knot/near", "knot/middle", "knot/far"},
          {"knot/near", "knot/middle", "knot/far"},
          [](BenchRun& run, const std::vector<std::string>& scenes) {
            return std::unique_ptr<AccuracyEffect>(std::make_unique<CurvatureSweep>(
                run, "curvature", scenes, curvatureSettings(), kCurvatureTruth));
          }};
}

}  // namespace glintmark
