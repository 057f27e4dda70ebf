#include "host/experiment/accuracy/glint_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.h"
#include "host/frame/effect/glint_table.h"
#include "host/microdetail/binomial_truth.h"
#include "host/microdetail/method_ratios.h"
#include "host/report/distribution.h"

namespace glintmark {
namespace {

constexpr int kLeastSide = 8;
constexpr double kReplicates = kGlintReplicates;
// Of a truth that is drawn: beyond the steps of a zoom, which seed draws that are judged.
constexpr std::uint32_t kTruthSeed = 1000;

double meanOf(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

std::vector<float> pooled(std::span<const std::vector<float>> parts) {
  std::vector<float> values;
  for (const std::vector<float>& part : parts)
    values.insert(values.end(), part.begin(), part.end());
  std::ranges::sort(values);
  return values;
}

// Rows: replicates; columns: steps of the zoom.
struct Grid {
  explicit Grid(int steps) : values(kGlintReplicates, std::vector<double>(steps)) {}
  std::vector<std::vector<double>> values;

  ReplicatedFigure figure(double scale = 1) const {
    ReplicatedFigure made;
    std::vector<double> steps(values.front().size(), 0.0);
    for (const std::vector<double>& replicate : values) {
      made.replicates.push_back(scale * meanOf(replicate));
      for (std::size_t z = 0; z < steps.size(); ++z) steps[z] += scale * replicate[z] / kReplicates;
    }
    made.swing = *std::ranges::max_element(steps) - *std::ranges::min_element(steps);
    return made;
  }
};

bool isSaneRatio(float ratio) {
  return std::isfinite(ratio) && ratio >= 0;
}

// A quotient that is 1 where both are 0.
double over(double a, double b) {
  return b > 0 ? a / b : a > 0 ? INFINITY : 1;
}

}  // namespace

double ReplicatedFigure::mean() const {
  return meanOf(replicates);
}

double ReplicatedFigure::standardError() const {
  const double middle = mean();
  double sum = 0;
  for (const double one : replicates) sum += (one - middle) * (one - middle);
  const auto n = static_cast<double>(replicates.size());
  return std::sqrt(sum / (n * (n - 1)));
}

double geometricMeanOf(std::span<const double> values) {
  double sum = 0;
  for (const double value : values) sum += std::log(value);
  return std::exp(sum / static_cast<double>(values.size()));
}

GlintJudge::GlintJudge(Device& device, ProgramCache& cache, int lanes, int side, Progress progress,
                       double most_details)
    : device_(device),
      cache_(cache),
      lanes_(lanes),
      side_(side),
      progress_(std::move(progress)),
      most_details_(most_details),
      stages_(glintStages()) {
  if (side < kLeastSide || side > 256)
    throw Error(
        fmt::format("a lattice of {} pixels a side is not from {} to 256", side, kLeastSide));
}

int GlintJudge::placeableSide(std::size_t stage) const {
  MicrodetailSurface surface;
  surface.material = glintMaterial(stages_[stage], 0);
  const double each = detailsPerPixel(glintLattice(stages_[stage], 0, 0, 1), surface);
  return std::min(static_cast<int>(std::sqrt(most_details_ / (2 * kReplicates * each))), side_);
}

int GlintJudge::truthSide(std::size_t stage) const {
  return std::max(placeableSide(stage), kLeastSide);
}

bool GlintJudge::isPlaced(std::size_t stage) const {
  return placeableSide(stage) >= kLeastSide;
}

GlintJudge::Placed GlintJudge::placeAlone(const PlacedKey& key) {
  const auto [filter, stage, replicate] = key;
  const int side = truthSide(stage);
  MicrodetailSurface surface;
  surface.material = glintMaterial(stages_[stage], 0);
  surface.seed = static_cast<std::uint32_t>(1 + replicate + kGlintReplicates * stage);
  const PixelLattice lattice = glintLattice(stages_[stage], replicate, 0, side);
  const glm::dvec2 motion = glintMotion(replicate);
  MicrodetailTruth truth(device_, cache_, lanes_);
  const std::string what =
      fmt::format("truth of aspect {}, lambda {}: replicate {} of {}", stages_[stage].aspect,
                  stages_[stage].lambda, replicate + 1, kGlintReplicates);
  const auto shown = [&](std::size_t, std::size_t) { progress_(what); };
  const MicrodetailRatios still =
      truth.place(lattice, surface, glintLight(stages_[stage]), filter, shown);
  const MicrodetailRatios moved = truth.place(lattice.moved(motion.x, motion.y), surface,
                                              glintLight(stages_[stage]), filter, shown);
  const MicrodetailRatios zoomed = truth.place(lattice.zoomed(kGlintZoomRatio), surface,
                                               glintLight(stages_[stage]), filter, shown);
  return {{redOf(still.reflecting), redOf(moved.reflecting), redOf(zoomed.reflecting), {}, side},
          {redOf(still.lobes), redOf(moved.lobes), redOf(zoomed.lobes), {}, side}};
}

GlintJudge::Placed GlintJudge::place(const PlacedKey& key) {
  const auto found = placed_.find(key);
  if (found == placed_.end()) return placeAlone(key);
  Placed placed = std::move(found->second);
  placed_.erase(found);
  return placed;
}

void GlintJudge::shareTruths(const Ranks& ranks, PixelFilter filter) {
  if (!shared_.insert(filter).second) return;
  std::vector<PlacedKey> keys;
  for (std::size_t stage = 0; stage < stages_.size(); ++stage)
    for (int r = 0; r < kGlintReplicates && isPlaced(stage); ++r)
      keys.emplace_back(filter, stage, r);
  std::string mine;
  const auto eachPart = [](Placed& placed, const auto& visit) {
    for (Frames* frames : {&placed.seen, &placed.lobes})
      for (std::vector<float>* part : {&frames->still, &frames->moved, &frames->zoomed})
        visit(*part);
  };
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (!ranks.makes(i)) continue;
    Placed placed = placeAlone(keys[i]);
    eachPart(placed, [&](const std::vector<float>& part) {
      mine.append(reinterpret_cast<const char*>(part.data()), part.size() * sizeof(float));
    });
  }
  const std::vector<std::string> all = ranks.gather(mine);
  std::vector<std::size_t> taken(all.size(), 0);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const int side = truthSide(std::get<1>(keys[i]));
    const std::size_t maker = i % all.size(), pixels = static_cast<std::size_t>(side * side);
    Placed& placed = placed_[keys[i]];
    placed.seen.columns = placed.lobes.columns = side;
    eachPart(placed, [&](std::vector<float>& part) {
      part.resize(pixels);
      taken[maker] += all[maker].copy(reinterpret_cast<char*>(part.data()), pixels * sizeof(float),
                                      taken[maker]);
    });
  }
}

const GlintJudge::Truth& GlintJudge::truth(std::size_t stage) {
  const auto found = truths_.find(stage);
  if (found != truths_.end()) return found->second;
  Truth made;
  const int side = truthSide(stage);
  if (!isPlaced(stage)) made.replicates = drawn(stage, side, kTruthSeed);
  std::vector<std::vector<float>> stills, lobe_stills;
  for (std::size_t r = 0; r < kGlintReplicates; ++r) {
    if (isPlaced(stage)) {
      Placed placed = place({PixelFilter::kBox, stage, static_cast<int>(r)});
      made.replicates.push_back(std::move(placed.seen));
      lobe_stills.push_back(placed.lobes.still);
      made.lobes.push_back(std::move(placed.lobes));
    }
    const Frames& frames = made.replicates[r];
    stills.push_back(frames.still);
    std::ranges::sort(stills.back());
    const GlintStatistics one = glintStatistics(frames.still, side, frames.moved);
    made.mean.mean += one.mean / kReplicates;
    made.mean.variance += one.variance / kReplicates;
    made.mean.dark += one.dark / kReplicates;
    made.mean.correlation += one.correlation / kReplicates;
    made.mean.change += one.change / kReplicates;
    made.mean.largest = std::max(made.mean.largest, one.largest);
    made.zoom_change += meanChange(frames.still, frames.zoomed) / kReplicates;
  }
  made.values = pooled(stills);
  made.lobe_values = pooled(lobe_stills);
  for (int r = 0; r < kGlintReplicates; ++r) {
    std::vector<std::vector<float>> others = stills;
    others.erase(others.begin() + r);
    made.noise += wassersteinDistance(stills[static_cast<std::size_t>(r)], pooled(others));
  }
  // One replicate from the other seven: the distance goes with sqrt(1 + 1/7) of one replicate's
  // error, that of two samples of eight each with sqrt(2/8).
  made.noise *= std::sqrt(2 / kReplicates / (1 + 1 / (kReplicates - 1))) / kReplicates;
  return truths_.emplace(stage, std::move(made)).first->second;
}

GlintFigures GlintJudge::judged(std::size_t stage, int steps,
                                const std::function<std::vector<Frames>(int)>& frames,
                                bool with_tent) {
  const Truth& right = truth(stage);
  const double bound = 1 / glintLight(stages_[stage]).probability;
  Grid mean(steps), variance(steps), dark(steps), largest(steps), correlation(steps), change(steps),
      zoom(steps), octave(steps);
  std::vector<double> errors, lobe_errors, tent_errors;
  GlintFigures made;
  made.zooms = steps > 1;
  bool has_octave = false;
  const std::vector<float>* const tent =
      with_tent && isPlaced(stage) ? &tentValues(stage) : nullptr;
  for (int step = 0; step < steps; ++step) {
    std::vector<std::vector<float>> stills;
    std::vector<Frames> replicates = frames(step);
    for (std::size_t r = 0; r < replicates.size(); ++r) {
      Frames& seen = replicates[r];
      for (const std::vector<float>* part : {&seen.still, &seen.moved, &seen.zoomed, &seen.doubled})
        made.sane = made.sane && std::ranges::all_of(*part, isSaneRatio);
      const GlintStatistics one = glintStatistics(seen.still, seen.columns, seen.moved);
      const auto store = [&](Grid& grid, double value) {
        grid.values[r][static_cast<std::size_t>(step)] = value;
      };
      store(mean, one.mean);
      store(variance, one.variance);
      store(dark, one.dark);
      store(largest, one.largest / bound);
      store(correlation, one.correlation);
      store(change, one.change);
      store(zoom, meanChange(seen.still, seen.zoomed));
      has_octave = !seen.doubled.empty();
      if (has_octave) store(octave, correlationOf(seen.still, seen.doubled));
      stills.push_back(std::move(seen.still));
    }
    if (!made.sane) return made;
    const std::vector<float> values = pooled(stills);
    errors.push_back(wassersteinDistance(values, right.values));
    if (!right.lobe_values.empty())
      lobe_errors.push_back(wassersteinDistance(values, right.lobe_values));
    if (tent != nullptr) tent_errors.push_back(wassersteinDistance(values, *tent));
  }
  made.error = meanOf(errors);
  made.error_swing = *std::ranges::max_element(errors) - *std::ranges::min_element(errors);
  made.noise = right.noise;
  if (!lobe_errors.empty()) made.lobes_error = meanOf(lobe_errors);
  if (tent != nullptr) made.tent_error = meanOf(tent_errors);
  made.mean = mean.figure();
  made.variance_ratio = variance.figure(over(1, right.mean.variance));
  made.dark = dark.figure();
  made.largest = largest.figure();
  for (std::size_t r = 0; r < kGlintReplicates; ++r)
    made.largest.replicates[r] = *std::ranges::max_element(largest.values[r]);
  made.correlation = correlation.figure();
  made.motion_ratio = change.figure(over(1, right.mean.change));
  // Where the truth sees one microdetail at least, a pixel that grows need not change.
  if (right.zoom_change > 0) made.zoom_ratio = zoom.figure(1 / right.zoom_change);
  if (has_octave) made.octave_correlation = octave.figure();
  made.truth_dark = right.mean.dark;
  made.truth_largest = right.mean.largest / bound;
  made.truth_correlation = right.mean.correlation;
  return made;
}

const std::vector<GlintJudge::Frames>& GlintJudge::tentFrames(std::size_t stage) {
  std::vector<Frames>& frames = tents_[stage];
  for (int r = static_cast<int>(frames.size()); r < kGlintReplicates; ++r)
    frames.push_back(place({PixelFilter::kTent, stage, r}).seen);
  return frames;
}

const std::vector<float>& GlintJudge::tentValues(std::size_t stage) {
  std::vector<float>& values = tent_values_[stage];
  if (!values.empty()) return values;
  std::vector<std::vector<float>> stills;
  for (const Frames& one : tentFrames(stage)) stills.push_back(one.still);
  return values = pooled(stills);
}

GlintFigures GlintJudge::method(const KernelConfig& config, std::size_t stage, bool with_tent) {
  return judged(
      stage, kGlintZoomSteps,
      [&](int step) {
        progress_("");
        std::vector<PixelLattice> lattices;
        for (int r = 0; r < kGlintReplicates; ++r) {
          const PixelLattice lattice = glintLattice(stages_[stage], r, step, side_);
          const glm::dvec2 motion = glintMotion(r);
          lattices.push_back(lattice);
          lattices.push_back(lattice.moved(motion.x, motion.y));
          lattices.push_back(lattice.zoomed(kGlintZoomRatio));
          lattices.push_back(lattice.zoomed(2));
        }
        const auto ratios = methodRatios(device_, cache_, config, lattices,
                                         glintMaterial(stages_[stage], step), kGlintHalfSlope,
                                         glintTable(device_, config, BufferPurpose::kMicrodetails));
        std::vector<Frames> frames;
        for (std::size_t i = 0; i < ratios.size(); i += 4)
          frames.push_back({redOf(ratios[i]), redOf(ratios[i + 1]), redOf(ratios[i + 2]),
                            redOf(ratios[i + 3]), side_});
        return frames;
      },
      with_tent);
}

std::vector<GlintJudge::Frames> GlintJudge::drawn(std::size_t stage, int side,
                                                  std::uint32_t seed) const {
  const double p = glintLight(stages_[stage]).probability;
  const auto pixels = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  std::vector<Frames> frames;
  for (std::uint32_t r = 0; r < kGlintReplicates; ++r) {
    const BinomialFrames draws =
        binomialFrames(pixels, stages_[stage].lambda / p, p, 1 - kGlintMotion_px, CountLaw::kFixed,
                       seed * kGlintReplicates + r, kGlintZoomRatio * kGlintZoomRatio);
    frames.push_back({draws.still, draws.moved, draws.zoomed, {}, side});
  }
  return frames;
}

GlintFigures GlintJudge::truthForm(const std::string& form, std::size_t stage) {
  // Draws like a method's: at every step of the zoom, as many pixels. So its swing is what chance
  // does.
  if (form == "binomial")
    return judged(
        stage, kGlintZoomSteps,
        [&](int step) { return drawn(stage, side_, static_cast<std::uint32_t>(step)); }, true);
  if (!isPlaced(stage))
    throw Error(fmt::format("microdetails of {} reflecting ones a pixel are too many to place",
                            stages_[stage].lambda));
  if (form == "lobes")
    return judged(
        stage, 1, [&](int) { return truth(stage).lobes; }, true);
  if (form == "tent")
    return judged(
        stage, 1, [&](int) { return tentFrames(stage); }, true);
  throw Error(fmt::format("the truth has no form '{}'", form));
}

}  // namespace glintmark
