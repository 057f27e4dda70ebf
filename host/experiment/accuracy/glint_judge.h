// Methods of glints against the truth of placed microdetails, over all stages of glint_axis.h.
#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "host/experiment/accuracy/glint_axis.h"
#include "host/microdetail/glint_statistics.h"
#include "host/microdetail/microdetail_truth.h"
#include "host/ocl/compute.h"
#include "host/parallel/ranks.h"

namespace glintmark {

/// A figure by replicate, each the mean over the steps of a zoom by two.
struct ReplicatedFigure {
  std::vector<double> replicates;
  double swing = 0;  // greatest less least over the steps, of the mean over replicates

  double mean() const;
  /// Of the mean, from the replicates' spread.
  double standardError() const;
};

/// One stage. Distances and changes are in units of the smooth lobe.
struct GlintFigures {
  double error = 0;                   // W1 to the truth, mean over the zoom
  double error_swing = 0;             // greatest less least over the zoom
  double noise = 0;                   // W1 of two samples of the truth as large as those compared
  std::optional<double> lobes_error;  // W1 to the truth whose microdetails mirror by their lobes
  std::optional<double> tent_error;   // W1 to the truth seen through a tent
  ReplicatedFigure mean;
  ReplicatedFigure variance_ratio;  // over the truth's
  ReplicatedFigure dark;            // share of pixels
  ReplicatedFigure largest;         // of a replicate's pixels, over the bound 1 / p
  ReplicatedFigure correlation;     // over one pixel
  ReplicatedFigure motion_ratio;    // change per quarter pixel over the truth's
  ReplicatedFigure zoom_ratio;      // change where pixels grow by kGlintZoomRatio, over the truth's
  /// Of a pixel with itself twice as long and wide; of independent microdetails 1/2, as those of
  /// the smaller are a quarter of the larger's. None of truths.
  ReplicatedFigure octave_correlation;
  double truth_dark = 0, truth_largest = 0, truth_correlation = 0;
  bool zooms = true;  // else there is no swing
  bool sane = true;   // no ratio is negative or not finite
};

/// The truth is that of [ZK16] Eq. 7, which all methods set out to compute: each microdetail
/// mirrors all of the light or none, with the share that its lobe says as the probability.
class GlintJudge {
 public:
  /// Says what it is doing; called often, may throw.
  using Progress = std::function<void(const std::string& what)>;

  /// Lattices of `side` x `side` pixels, 8 to 256; of the truth, less where `most_details` is not
  /// enough for so many, and where it is not enough for 8 either, the truth is drawn: one binomial
  /// a pixel, and no lobes or tents.
  GlintJudge(Device& device, ProgramCache& cache, int lanes, int side, Progress progress,
             double most_details = kMostDetails);
  /// That are placed for the truth of one stage: some seconds on two cores.
  static constexpr double kMostDetails = 6e8;

  /// By a program of `config` (glint on, no size variation). A truth with tents takes four times as
  /// long to place.
  GlintFigures method(const KernelConfig& config, std::size_t stage, bool with_tent);

  /// Of all `ranks`: places the microdetails of all truths that can be placed, which the ranks deal
  /// out among them; once. Without it they are placed when they are first needed. Box: those that
  /// methods are held against; tent: those of tents.
  void shareTruths(const Ranks& ranks, PixelFilter filter);

  /// Other forms of the truth held against it: kTruthForms.
  GlintFigures truthForm(const std::string& form, std::size_t stage);

 private:
  // The frames of one sample: a lattice, the same a quarter of a pixel on, its pixels a little
  // larger, and, of methods, twice as long and wide.
  struct Frames {
    std::vector<float> still, moved, zoomed, doubled;
    int columns = 1;
  };
  struct Truth {
    std::vector<Frames> replicates, lobes;
    std::vector<float> values, lobe_values;  // of all replicates, ascending
    GlintStatistics mean;                    // over the replicates; `largest` of all
    double zoom_change = 0;                  // meanChange() to pixels that are a little larger
    double noise = 0;                        // W1 of two independent samples of that size
  };
  // Of one sample, before anything is made of it.
  struct Placed {
    Frames seen, lobes;
  };
  using PlacedKey = std::tuple<PixelFilter, std::size_t, int>;  // stage, replicate
  Placed placeAlone(const PlacedKey& key);
  const Truth& truth(std::size_t stage);
  // That of shareTruths(), once, or placed now.
  Placed place(const PlacedKey& key);
  // How many pixels a side can be placed, at most `side_`; not below 8 in truthSide().
  int placeableSide(std::size_t stage) const;
  int truthSide(std::size_t stage) const;
  bool isPlaced(std::size_t stage) const;
  // `frames` of all replicates at a step of the zoom.
  GlintFigures judged(std::size_t stage, int steps,
                      const std::function<std::vector<Frames>(int step)>& frames, bool with_tent);
  const std::vector<Frames>& tentFrames(std::size_t stage);
  const std::vector<float>& tentValues(std::size_t stage);
  // One binomial a pixel, of all replicates; another `seed`, other draws.
  std::vector<Frames> drawn(std::size_t stage, int side, std::uint32_t seed) const;

  Device& device_;
  ProgramCache& cache_;
  int lanes_, side_;
  Progress progress_;
  double most_details_;
  std::vector<GlintStage> stages_;
  std::set<PixelFilter> shared_;
  std::map<PlacedKey, Placed> placed_;  // by shareTruths(), until a truth is made of it
  std::map<std::size_t, Truth> truths_;
  std::map<std::size_t, std::vector<Frames>> tents_;
  std::map<std::size_t, std::vector<float>> tent_values_;  // of all replicates, ascending
};

/// "lobes": microdetails mirror the share that their lobes say, instead of all or nothing [ZK16]
/// Eq.
/// 7. "tent": a pixel is a tent. "binomial": one draw of Binomial(density * area, p) a pixel.
inline constexpr const char* kTruthForms[] = {"lobes", "tent", "binomial"};

/// Geometric mean; 0 if one is 0.
double geometricMeanOf(std::span<const double> values);

}  // namespace glintmark
