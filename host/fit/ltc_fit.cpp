#include "host/fit/ltc_fit.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <vector>

#include "host/core/error.h"
#include "host/fit/ltc_objective.h"
#include "host/fit/minimize.h"
#include "host/reference/ltc.h"

namespace glintmark {
namespace {

// Times that every cell is fitted again from its neighbours' lobes. More gain nothing visible.
constexpr int kRefinements = 2;

// Column 0 stands for the limit of alpha -> 0; this column is close enough to measure it at.
constexpr double kFirstColumn = 0.2;

// Samples for the albedos, which want to be good to 1e-4 and are needed once per cell.
constexpr LtcSampleCounts kAlbedoSamples = {
    .lobe_radial = 128, .lobe_azimuth = 48, .hemisphere_radial = 96, .hemisphere_azimuth = 64};

// The last digits are the cubature's anyway. A quarter of a lobe's width is as far as its slope
// tells where to go.
constexpr MinimizeLimits kLimits = {.iterations = 50, .least_gain = 1e-7, .unit = 0.25};

using Parameters = std::array<double, 4>;

// Minimisation in variables scaled to the lobe: turning it by its width is as large a step as
// making it e times wider.
class ScaledProblem {
 public:
  ScaledProblem(const LtcSamples& samples, const LtcLobe& start, bool symmetric)
      : samples_(samples),
        symmetric_(symmetric),
        tilt_unit_(std::min(std::exp(start.log_width_x), 1.0)) {}

  Parameters scaled(const LtcLobe& l) const {
    return {l.log_width_x, l.log_width_y, l.shear, l.tilt_rad / tilt_unit_};
  }
  LtcLobe lobe(const Parameters& p) const { return {p[0], p[1], p[2], p[3] * tilt_unit_}; }

  double operator()(const Parameters& p, Parameters& gradient) const {
    const double error = ltcFitError(samples_, lobe(p), gradient);
    gradient[3] *= tilt_unit_;
    if (symmetric_) {
      const double mean = 0.5 * (gradient[0] + gradient[1]);
      gradient = {mean, mean, 0, 0};
    }
    return error;
  }

 private:
  const LtcSamples& samples_;
  bool symmetric_;
  double tilt_unit_;
};

// What a lobe becomes at `factor` times the roughness: as much wider, and off the mirrored
// direction by that factor squared.
LtcLobe scaledLobe(const LtcLobe& lobe, double factor, double cos_theta) {
  const double mirror_rad = -std::acos(cos_theta);
  LtcLobe scaled = lobe;
  scaled.log_width_x += std::log(factor);
  scaled.log_width_y += std::log(factor);
  scaled.tilt_rad = mirror_rad + (lobe.tilt_rad - mirror_rad) * factor * factor;
  return scaled;
}

class TableFit {
 public:
  TableFit(const LtcFitOptions& options) : options_(options), size_(options.size) {
    lobes_.resize(static_cast<std::size_t>(size_) * size_);
  }

  LtcTable run() {
    overRows([this](int y) { fitRow(y); });
    shareLobes();
    for (int pass = 0; pass < kRefinements; ++pass) {
      const std::vector<LtcLobe> before = lobes_;
      overRows([&](int y) { refineRow(before, y); });
      shareLobes();
    }
    LtcTable table(options_.ndf, size_);
    overRows([&](int y) { storeRow(table, y); });
    shareRows(*options_.ranks, std::span(table.values),
              static_cast<std::size_t>(size_) * LTC_CELL_FLOATS);
    return table;
  }

 private:
  // Those of this rank.
  template <typename Row>
  void overRows(const Row& row) {
    tbb::parallel_for(
        0, size_,
        [&](int y) {
          if (options_.ranks->makes(static_cast<std::size_t>(y))) row(y);
        },
        tbb::simple_partitioner());
  }

  void shareLobes() {
    shareRows(*options_.ranks, std::span(lobes_), static_cast<std::size_t>(size_));
  }

  LtcLobe& lobe(int x, int y) { return lobes_[static_cast<std::size_t>(y) * size_ + x]; }

  // From rough to smooth. Narrow lobes can be tilted or sheared to nearly the same effect; what
  // the rougher neighbour has settled on keeps the table smooth where little else decides.
  void fitRow(int y) {
    const double cosine = ltcRowCosine(y, size_);
    LtcLobe start;
    for (int x = size_ - 1; x > 0; --x) {
      start = fitLtcLobe(options_.ndf, ltcFitAlpha(x, size_), cosine, {&start, 1}, y == 0);
      lobe(x, y) = start;
      start = scaledLobe(start, ltcFitAlpha(x - 1, size_) / ltcFitAlpha(x, size_), cosine);
    }
    rowDone();
  }

  void refineRow(const std::vector<LtcLobe>& before, int y) {
    const auto at = [&](int x, int row) {
      return before[static_cast<std::size_t>(row) * size_ + x];
    };
    const double cosine = ltcRowCosine(y, size_);
    for (int x = 1; x < size_; ++x) {
      const double alpha = ltcFitAlpha(x, size_);
      std::vector<LtcLobe> starts = {at(x, y)};
      for (const int from : {x - 1, x + 1}) {
        if (y == 0 || from < 1 || from >= size_) continue;
        starts.push_back(scaledLobe(at(from, y), alpha / ltcFitAlpha(from, size_), cosine));
      }
      for (const int from : {y - 1, y + 1}) {
        if (from >= 1 && from < size_) starts.push_back(at(x, from));
      }
      lobe(x, y) = fitLtcLobe(options_.ndf, alpha, cosine, starts, y == 0);
    }
    // The limit of alpha -> 0: a lobe as wide as alpha times something. At the horizon it is not,
    // there its width across goes with alpha squared.
    const double factor = ltcFitAlpha(0, size_) / ltcFitAlpha(1, size_);
    lobe(0, y) = scaledLobe(lobe(1, y), factor, cosine);
    if (cosine <= 0) {
      LtcLobe start = lobe(0, y);
      start.log_width_y += std::log(factor);
      lobe(0, y) = fitLtcLobe(options_.ndf, ltcFitAlpha(0, size_), cosine, {&start, 1}, false);
    }
    rowDone();
  }

  void storeRow(LtcTable& table, int y) {
    const double cosine = ltcRowCosine(y, size_);
    for (int x = 0; x < size_; ++x) {
      const double alpha = ltcFitAlpha(x, size_);
      LtcCell cell{.albedo = 1, .schlick_albedo = std::pow(1 - cosine, 5)};  // of a mirror
      if (x > 0) {
        const LtcSamples samples =
            makeLtcSamples(options_.ndf, alpha, cosine, lobe(x, y), kAlbedoSamples);
        cell.albedo = std::min(samples.albedo, 1.0);
        cell.schlick_albedo = samples.schlick_albedo;
      }
      const bool cut = options_.ndf != reference::Ndf::kNormals;
      const double mass = cut ? reference::ltcMassAboveHorizon(ltcInverseMatrix(lobe(x, y))) : 1;
      cell.scale = cell.albedo / mass;
      cell.schlick = cell.schlick_albedo / mass;
      storeLobe(lobe(x, y), alpha, cosine, cell);
      table.setCell(x, y, cell);
    }
    rowDone();
  }

  void rowDone() {
    const std::scoped_lock lock(progress_mutex_);
    ++rows_done_;
    if (options_.progress)
      options_.progress(
          std::min(1.0, rows_done_ * options_.ranks->size() / ((2.0 + kRefinements) * size_)));
  }

  const LtcFitOptions& options_;
  int size_;
  std::vector<LtcLobe> lobes_;
  std::mutex progress_mutex_;
  int rows_done_ = 0;
};

}  // namespace

LtcLobe fitLtcLobe(reference::Ndf ndf, double alpha, double cos_theta,
                   std::span<const LtcLobe> starts, bool symmetric) {
  const LtcSamples samples = makeLtcSamples(ndf, alpha, cos_theta, starts.front());
  const auto error = [&](const LtcLobe& lobe) {
    Parameters unused;
    return ltcFitError(samples, lobe, unused);
  };
  const LtcLobe* rival = nullptr;
  for (const LtcLobe& start : starts.subspan(1)) {
    if (rival == nullptr || error(start) < error(*rival)) rival = &start;
  }
  LtcLobe best;
  double least = std::numeric_limits<double>::infinity();
  for (const LtcLobe* start : {&starts.front(), rival}) {
    if (start == nullptr) continue;
    const ScaledProblem problem(samples, *start, symmetric);
    const Minimum<4> found = minimize<4>(problem, problem.scaled(*start), kLimits);
    if (found.value >= least) continue;
    least = found.value;
    best = problem.lobe(found.at);
  }
  return best;
}

double ltcFitAlpha(int x, int size) {
  const double root = std::max<double>(x, kFirstColumn) / (size - 1);
  return root * root;
}

LtcTable fitLtcTable(const LtcFitOptions& options) {
  if (options.size < LTC_SIZE_MIN || options.size > LTC_SIZE_MAX) {
    throw Error(fmt::format("an LTC table of size {} is not possible; sizes are {} to {}",
                            options.size, LTC_SIZE_MIN, LTC_SIZE_MAX));
  }
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  return arena.execute([&] { return TableFit(options).run(); });
}

}  // namespace glintmark
