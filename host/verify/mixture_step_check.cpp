#include "host/verify/mixture_step_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/filter/mip_texels.h"
#include "host/mixture/mixture_fit_types.h"
#include "host/reference/mixture_step.h"

namespace glintmark {
namespace {

using reference::NormalLobe;

constexpr int kLobes = 4;
constexpr float kPriorWeight = 1.5f;  // the paper's C; other than 1, so that it is seen to count
// Responsibilities are as good as the exponents of their densities. Of four lobes some lies within
// 0.7 of any normal here, and variances are 5e-3 or more: exponents that count are below
// 0.49 / 0.01 * log2(e) = 71. Slope, square and sum are rounded by 2^-24 each and exp2 by 1e-7,
// together 9e-6 of a responsibility where all comes together; means are within 0.65, weights and
// variances below 1.
constexpr double kStepTolerance = 1e-5;
constexpr double kLeastWeight = 1e-5;

// A level between a coarser and a finer one, over normals, and lobes for all three.
struct GivenLevel {
  int map_width, map_height, level;
  MipTexels state;          // weight, mean x, mean y, variance of each lobe
  std::vector<float> x, y;  // normals
};

GivenLevel givenLevel(int map_width, int map_height, int level) {
  GivenLevel given{map_width, map_height, level, makeMipTexels(map_width, map_height, kLobes),
                   {},        {}};
  std::mt19937 random(21);
  const auto uniform = [&](double low, double high) {
    return static_cast<float>(low + (high - low) * static_cast<double>(random()) * 0x1p-32);
  };
  for (std::size_t texel = 0; texel < given.state.texelCount(); ++texel) {
    float4* lobes = &given.state.texels[texel * kLobes];
    float sum = 0;
    for (int i = 0; i < kLobes; ++i) {
      lobes[i] = {uniform(0.05, 1), uniform(-0.45, 0.45), uniform(-0.45, 0.45), uniform(5e-3, 0.1)};
      sum += lobes[i].x;
    }
    for (int i = 0; i < kLobes; ++i) lobes[i].x /= sum;
  }
  for (int i = 0; i < map_width * map_height + MF_SLOTS; ++i) {
    given.x.push_back(uniform(-0.45, 0.45));
    given.y.push_back(uniform(-0.45, 0.45));
  }
  return given;
}

// Which of its neighbours a texel may see.
struct Round {
  bool first_sweep, from_parent, sees_finer;
};
constexpr Round kRounds[] = {{true, true, false}, {true, false, false}, {false, false, true}};

std::vector<NormalLobe> lobesAt(const MipTexels& state, int level, int x, int y) {
  std::vector<NormalLobe> lobes;
  for (int i = 0; i < kLobes; ++i) {
    const float4& lobe = state.at(level, x, y)[i];
    lobes.push_back({lobe.x, {lobe.y, lobe.z}, lobe.w});
  }
  return lobes;
}

// What lies under a texel of a level of `coarse` of the map's `fine` texels along one axis.
double sharedLength(int i, int fine, int x, int coarse) {
  const double scale = static_cast<double>(fine) / coarse;
  return std::max(0.0, std::min(i + 1.0, (x + 1) * scale) - std::max<double>(i, x * scale));
}

class Expected {
 public:
  Expected(const GivenLevel& given, const Round& round)
      : given_(given),
        round_(round),
        width_(given.state.levelWidth(given.level)),
        height_(given.state.levelHeight(given.level)) {}

  std::vector<NormalLobe> at(int x, int y) const {
    return reference::mixtureStep(start(x, y), normals(x, y), neighbours(x, y), kPriorWeight);
  }

 private:
  std::vector<NormalLobe> parent(int x, int y) const {
    const int columns = given_.state.levelWidth(given_.level + 1);
    const int rows = given_.state.levelHeight(given_.level + 1);
    return lobesAt(given_.state, given_.level + 1, x * columns / width_, y * rows / height_);
  }

  std::vector<NormalLobe> start(int x, int y) const {
    if (!round_.from_parent) return lobesAt(given_.state, given_.level, x, y);
    std::vector<NormalLobe> lobes = parent(x, y);
    for (NormalLobe& lobe : lobes) lobe.weight = 0.5 * (lobe.weight + 1.0 / kLobes);
    return lobes;
  }

  std::vector<reference::CoveredNormal> normals(int x, int y) const {
    std::vector<reference::CoveredNormal> all;
    for (int j = 0; j < given_.map_height; ++j)
      for (int i = 0; i < given_.map_width; ++i) {
        const double share = sharedLength(i, given_.map_width, x, width_) *
                             sharedLength(j, given_.map_height, y, height_);
        const std::size_t at = static_cast<std::size_t>(j) * given_.map_width + i;
        if (share > 0) all.push_back({{given_.x[at], given_.y[at]}, share});
      }
    return all;
  }

  // The colours (x mod 2) + 2 (y mod 2) are fitted one after the other; the map repeats.
  std::vector<std::vector<NormalLobe>> neighbours(int x, int y) const {
    std::vector<std::vector<NormalLobe>> all = {parent(x, y)};
    const int own = x % 2 + 2 * (y % 2);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const int u = (x + dx + width_) % width_, v = (y + dy + height_) % height_;
        const int other = u % 2 + 2 * (v % 2);
        if (round_.first_sweep ? other < own : other != own)
          all.push_back(lobesAt(given_.state, given_.level, u, v));
      }
    if (!round_.sees_finer) return all;
    for (int v = 2 * y; v < 2 * y + 2; ++v)
      for (int u = 2 * x; u < 2 * x + 2; ++u)
        all.push_back(lobesAt(given_.state, given_.level - 1, u, v));
    return all;
  }

  const GivenLevel& given_;
  const Round round_;
  const int width_, height_;
};

MixtureFitRun runOf(const GivenLevel& given, const Round& round, int lanes, int colour) {
  MixtureFitRun run{};
  const MipTexels& state = given.state;
  const auto place = [&](int level, int& first, int& width, int& height) {
    first = static_cast<int>(state.layout.first[level]);
    width = state.levelWidth(level), height = state.levelHeight(level);
  };
  place(given.level, run.first, run.width, run.height);
  place(given.level + 1, run.parent_first, run.parent_width, run.parent_height);
  if (round.sees_finer) place(given.level - 1, run.finer_first, run.finer_width, run.finer_height);
  run.map_width = given.map_width, run.map_height = given.map_height;
  for (int x = 0; x < run.width; ++x) {
    int columns = 0;
    for (int i = 0; i < given.map_width; ++i)
      columns += sharedLength(i, given.map_width, x, run.width) > 0 ? 1 : 0;
    run.most_columns = std::max(run.most_columns, columns);
  }
  run.origin_x = colour % 2, run.origin_y = colour / 2;
  run.columns = (run.width + 1 - run.origin_x) / 2, run.rows = (run.height + 1 - run.origin_y) / 2;
  run.items_per_row = (run.columns + lanes - 1) / lanes;
  run.rows_per_chunk = 3;  // the last chunk is not full
  run.chunks = (given.map_height / run.height + 2 + run.rows_per_chunk - 1) / run.rows_per_chunk;
  run.max_iterations = 1;
  run.first_sweep = round.first_sweep, run.from_parent = round.from_parent;
  run.prior_weight = kPriorWeight, run.tolerance = 1e-30f;
  run.normals = static_cast<float>(static_cast<double>(given.map_width) / run.width *
                                   given.map_height / run.height);
  return run;
}

// The fit's kernels over one colour of a level.
class DeviceStep {
 public:
  DeviceStep(const CheckContext& context, const GivenLevel& given)
      : bench_(context.bench),
        lanes_(context.lanes),
        program_(bench_.cache.getWithOptions(
            "mixture/mixture_fit.cl", fmt::format("-D WIDTH={} -D LOBES={}", lanes_, kLobes))),
        x_(probeData(bench_, given.x)),
        y_(probeData(bench_, given.y)) {}

  /// `given.state` after the step.
  MipTexels run(const GivenLevel& given, const MixtureFitRun& run) {
    const std::vector<float4> texels(given.state.texels.begin(), given.state.texels.end());
    const Buffer state = probeData(bench_, texels);
    const Buffer parameters = probeData(bench_, std::vector{run});
    if (run.most_columns < MF_SLOTS) {
      launch("fitTexels", {x_, y_, parameters, state, zeros(128)}, run.rows * run.items_per_row);
    } else {
      stepOverRows(run, parameters, state);
    }
    MipTexels after = given.state;
    state.read(after.texels.data(), after.texels.size() * sizeof(float4));
    return after;
  }

 private:
  void stepOverRows(const MixtureFitRun& run, const Buffer& parameters, const Buffer& state) {
    const int texels = run.rows * run.columns, items = run.rows * run.items_per_row;
    const Buffer prior = zeros(3 * kLobes * texels), status = zeros(texels);
    const Buffer partials = zeros(texels * run.chunks * MF_SUMS(kLobes) * MF_SLOTS);
    const Buffer sums = zeros(texels * MF_SUMS(kLobes));
    launch("startTexels", {parameters, state, prior, status}, items);
    launch("expectRows", {x_, y_, parameters, state, status, std::uint32_t{0}, partials},
           texels * run.chunks * (MF_SLOTS / lanes_));
    launch("addPartials", {parameters, partials, sums}, texels * MF_SUMS(kLobes));
    launch("maximizeTexels", {parameters, sums, prior, state, status}, items);
  }

  Buffer zeros(int words) {
    return probeData(bench_, std::vector<std::uint32_t>(static_cast<std::size_t>(words)));
  }

  void launch(const char* kernel, const std::vector<KernelArg>& arguments, int items) {
    program_.kernel(kernel).launch(arguments, static_cast<std::size_t>(items), kLocalSize);
  }

  KernelBench& bench_;
  const int lanes_;
  const Program program_;
  const Buffer x_, y_;
};

void compare(const GivenLevel& given, const Round& round, const MixtureFitRun& run,
             const MipTexels& after, Finding& finding) {
  const Expected expected(given, round);
  for (int y = run.origin_y; y < run.height; y += 2)
    for (int x = run.origin_x; x < run.width; x += 2) {
      const std::vector<NormalLobe> want = expected.at(x, y);
      const std::vector<NormalLobe> got = lobesAt(after, given.level, x, y);
      for (int i = 0; i < kLobes; ++i) {
        finding.add(std::abs(got[i].weight - want[i].weight));
        finding.add(glm::length(got[i].mean - want[i].mean));
        // A lobe of next to no normals keeps its variance.
        if (want[i].weight > kLeastWeight)
          finding.add(std::abs(got[i].variance - want[i].variance));
      }
    }
}

}  // namespace

Finding oneStepFromGivenLobes(const CheckContext& context) {
  Finding finding(kStepTolerance);
  // Sides that nest and that do not; rows of at most five normals, and of seventeen.
  for (const GivenLevel& given :
       {givenLevel(40, 24, 2), givenLevel(21, 27, 2), givenLevel(163, 50, 4)}) {
    DeviceStep step(context, given);
    for (const Round& round : kRounds)
      for (int colour = 0; colour < 4; ++colour) {
        const MixtureFitRun run = runOf(given, round, context.lanes, colour);
        compare(given, round, run, step.run(given, run), finding);
      }
  }
  return finding;
}

}  // namespace glintmark
