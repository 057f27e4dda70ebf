#include "host/filter/normal_map_generators.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <span>

#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/filter/all_rows.h"

namespace glintmark {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

/// Where the texels of a map lie: u of every column, which is v of every row, too.
using Places = std::vector<double>;

/// Heights of columns [first, first + heights.size()) of rows at `v`.
using Row = std::function<void(double v, std::size_t first, std::span<double> heights)>;

/// Uniform in [0, 1), the same on every platform.
double uniform(std::mt19937& random) {
  return random() * 0x1p-32;
}

/// 0 below `from`, 1 above `to`, smooth between.
double step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

/// Distance to the nearest whole number, with the sign of the way back.
double wrapped(double x) {
  return x - std::round(x);
}

/// Height of a unit half circle over [-1, 1], 0 outside.
double halfCircle(double x) {
  return std::sqrt(std::max(0.0, 1 - x * x));
}

/// Texels that are made at once: their cosines by column stay in the cache from row to row.
constexpr std::size_t kColumnsAtOnce = 256;
constexpr int kBandRows = 16;

/// Sum of cosines with whole-numbered wave vectors: smooth noise of period 1, standard deviation 1.
/// By cos(a + b) = cos a cos b - sin a sin b, so that a texel costs two products a wave.
class PeriodicNoise {
 public:
  /// `waves` waves of `lowest` to `highest` cycles per period.
  PeriodicNoise(const Places& places, std::uint32_t seed, int waves, double lowest, double highest)
      : size_(places.size()), scale_(std::sqrt(2.0 / waves)) {
    std::mt19937 random(seed);
    for (int i = 0; i < waves; ++i) {
      const double cycles = lowest + (highest - lowest) * uniform(random);
      const double angle_rad = kTwoPi * uniform(random);
      const double u = kTwoPi * std::round(cycles * std::cos(angle_rad));
      const double v = kTwoPi * std::round(cycles * std::sin(angle_rad));
      waves_.push_back({v, kTwoPi * uniform(random)});
      for (const double place : places) cosines_.push_back(std::cos(u * place));
      for (const double place : places) sines_.push_back(std::sin(u * place));
    }
  }

  /// Adds `height` times the noise to each of a row's columns from `first` on.
  void addTo(double height, double v, std::size_t first, std::span<double> row) const {
    for (std::size_t i = 0; i < waves_.size(); ++i) {
      const double phase = waves_[i].v * v + waves_[i].phase;
      const double c = height * scale_ * std::cos(phase), s = height * scale_ * std::sin(phase);
      const double* const cosines = cosines_.data() + i * size_ + first;
      const double* const sines = sines_.data() + i * size_ + first;
      for (std::size_t x = 0; x < row.size(); ++x) row[x] += c * cosines[x] - s * sines[x];
    }
  }

 private:
  struct Wave {
    double v, phase;
  };
  std::size_t size_;
  double scale_;
  std::vector<Wave> waves_;
  std::vector<double> cosines_, sines_;  // of u, wave by wave
};

/// Of heights that are made one by one.
template <class HeightAt>
Row rowOf(const Places& places, const HeightAt& height) {
  return [&places, height](double v, std::size_t first, std::span<double> row) {
    for (std::size_t x = 0; x < row.size(); ++x) row[x] = height(places[first + x], v);
  };
}

// Smooth from 0 at `inner` to 1 and back to 0 at `outer`.
double window(double inner, double outer, double r) {
  return step(inner, inner + 0.008, r) * (1 - step(outer - 0.008, outer, r));
}

// Rings of ornament around the centre, each inside its own smooth window, none of which touch.
double carving(double x, double y, double r) {
  if (r >= 0.42) return 0.0016 * std::cos(kTwoPi * r / 0.016) * window(0.42, 0.48, r);
  const double angle_rad = std::atan2(y, x);
  if (r < 0.09) return 0.012 * (std::cos(8 * angle_rad) * r / 0.09) * window(0.0, 0.09, r);
  if (r < 0.19)
    return 0.010 * (std::abs(std::cos(28 * angle_rad)) * r / 0.15) * window(0.10, 0.19, r);
  if (r < 0.33) {
    const double scrolls = std::cos(10 * angle_rad + 70 * kTwoPi * r * 0.3) *
                           std::cos(10 * angle_rad - 70 * kTwoPi * r * 0.3);
    return 0.008 * scrolls * window(0.20, 0.33, r);
  }
  const double bead_angle = wrapped(36 * angle_rad / kTwoPi) / 36 * kTwoPi * 0.375;
  return 0.022 * halfCircle(std::hypot(bead_angle, r - 0.375) / 0.03) * window(0.335, 0.415, r);
}

Row disk(const Places& places, std::uint32_t seed) {
  return [&places, tool_marks = PeriodicNoise(places, seed, 24, 40, 90)](
             double v, std::size_t first, std::span<double> row) {
    std::ranges::fill(row, 0.0);
    tool_marks.addTo(1, v, first, row);
    const double y = v - 0.5;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double x = places[first + i] - 0.5, r = std::hypot(x, y);
      if (r >= 0.4995) {
        row[i] = 0;
        continue;
      }
      const double marks = 4e-5 * row[i] * (1 - step(0.47, 0.49, r));
      const double rim = 0.01 * step(0.485, 0.49, r) * (1 - step(0.495, 0.4995, r));
      row[i] = (r < 0.48 ? carving(x, y, r) : 0.0) + marks + rim;
    }
  };
}

// Every point belongs to the highest of the caps around it.
Row armour(const Places& places, std::uint32_t) {
  return rowOf(places, [](double u, double v) {
    constexpr int kRows = 32, kColumns = 32;
    constexpr double kRadius = 0.62 / kRows;
    double height = 0;
    const int row = static_cast<int>(std::floor(v * kRows));
    for (int r = row - 1; r <= row + 1; ++r) {
      const double shift = (r & 1) ? 0.5 : 0.0;
      const double dx = wrapped(u * kColumns - shift - 0.5) / kColumns;
      const double dy = v - (r + 0.5) / kRows;
      height = std::max(height, kRadius * halfCircle(std::hypot(dx, dy) / kRadius));
    }
    return height;
  });
}

Row dunes(const Places& places, std::uint32_t seed) {
  return [&places, slow = PeriodicNoise(places, seed, 12, 1, 5),
          bend = PeriodicNoise(places, seed + 1, 16, 2, 9),
          grains = PeriodicNoise(places, seed + 2, 24, 60, 120)](double v, std::size_t first,
                                                                 std::span<double> row) {
    constexpr int kRipples = 24;
    std::array<double, kColumnsAtOnce> bends{};
    const std::span<double> leans = std::span(bends).first(row.size());
    bend.addTo(1.3, v, first, leans);
    std::ranges::fill(row, 0.0);
    slow.addTo(0.006, v, first, row);
    grains.addTo(1e-4, v, first, row);
    for (std::size_t x = 0; x < row.size(); ++x) {
      // Steep lee, gentle windward side: a cosine whose phase leans on itself.
      const double phase = kTwoPi * (kRipples * v + 3 * places[first + x]) + leans[x];
      row[x] += 0.0035 * std::cos(phase + 0.6 * std::sin(phase));
    }
  };
}

// Plain weave of threads.
double weave(double u, double v) {
  constexpr int kThreads = 32;  // even, so that over and under meet at the seam
  constexpr int kTwists = 8;    // strands across a thread's period
  // One system of threads along `along`; `side` shifts which crossings it passes above.
  const auto thread = [](double along, double across, double side) {
    const double index = std::floor(across * kThreads);
    const double offset = wrapped(across * kThreads - 0.5);
    const double wave = std::cos(std::numbers::pi * (along * kThreads - 0.5 + index + side));
    const double strands =
        0.06 * std::cos(kTwoPi * kTwists * (along * kThreads + 1.5 * offset) / 4.0);
    return (0.45 * halfCircle(offset / 0.48) + 0.25 * wave + strands) / kThreads;
  };
  return std::max(thread(u, v, 0), thread(v, u, 1));
}

Row cloth(const Places& places, std::uint32_t seed) {
  return [threads = rowOf(places, weave), unevenness = PeriodicNoise(places, seed, 16, 2, 30)](
             double v, std::size_t first, std::span<double> row) {
    threads(v, first, row);
    unevenness.addTo(4e-4, v, first, row);
  };
}

Row bumps(const Places& places, std::uint32_t seed) {
  return [coarse = PeriodicNoise(places, seed, 32, 10, 25),
          fine = PeriodicNoise(places, seed + 1, 48, 50, 110)](double v, std::size_t first,
                                                               std::span<double> row) {
    std::ranges::fill(row, 0.0);
    coarse.addTo(1.2e-3, v, first, row);
    fine.addTo(4e-4, v, first, row);
  };
}

Row flat(const Places&, std::uint32_t) {
  return [](double, std::size_t, std::span<double> row) { std::ranges::fill(row, 0.0); };
}

struct Generator {
  const char* kind;
  Row (*make)(const Places& places, std::uint32_t seed);  // refers to the places
};

constexpr std::array kGenerators = {Generator{"flat", flat},     Generator{"disk", disk},
                                    Generator{"armour", armour}, Generator{"dunes", dunes},
                                    Generator{"cloth", cloth},   Generator{"bumps", bumps}};

}  // namespace

std::vector<std::string> normalMapGenerators() {
  std::vector<std::string> names;
  names.reserve(std::size(kGenerators));
  for (const Generator& generator : kGenerators) names.emplace_back(generator.kind);
  return names;
}

Image generateHeights(const NormalMapRecipe& recipe) {
  const auto generator =
      std::ranges::find_if(kGenerators, [&](const Generator& g) { return recipe.kind == g.kind; });
  if (generator == kGenerators.end()) {
    throw Error(fmt::format("unknown normal map '{}'; generators are {}", recipe.kind,
                            fmt::join(normalMapGenerators(), ", ")));
  }
  if (recipe.size_px < 1 || recipe.size_px > kMaxNormalMapSize_px) {
    throw Error(fmt::format("a generated normal map cannot have {} texels per side; it has 1 to {}",
                            recipe.size_px, kMaxNormalMapSize_px));
  }
  const int size = recipe.size_px;
  requireMemory(
      normalMapBytes(size, size, true),
      fmt::format("the generated normal map '{}' of {}x{} texels", recipe.kind, size, size));
  Places places;
  for (int x = 0; x < size; ++x) places.push_back((x + 0.5) / size);
  const Row row = generator->make(places, recipe.seed);
  Image heights(size, size, 1);
  const auto makeRow = [&](int y, std::size_t first, std::size_t count) {
    std::array<double, kColumnsAtOnce> made;
    row(places[static_cast<std::size_t>(y)], first, std::span(made).first(count));
    std::transform(made.begin(), made.begin() + static_cast<std::ptrdiff_t>(count),
                   heights.at(static_cast<int>(first), y).data(),
                   [](double height) { return static_cast<float>(height); });
  };
  const std::string what = fmt::format("the heights of map {}", recipe.kind);
  forAllRows((size + kBandRows - 1) / kBandRows, what, [&](int band) {
    const int end = std::min(size, (band + 1) * kBandRows);
    for (std::size_t first = 0; first < places.size(); first += kColumnsAtOnce)
      for (int y = band * kBandRows; y < end; ++y)
        makeRow(y, first, std::min(kColumnsAtOnce, places.size() - first));
  });
  return heights;
}

NormalMap generateNormalMap(const NormalMapRecipe& recipe) {
  return normalsFromHeights(generateHeights(recipe), recipe.height_scale, recipe.kind);
}

}  // namespace glintmark
