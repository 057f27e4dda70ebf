#include "host/filter/normal_map_generators.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

using Height = std::function<double(double u, double v)>;

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

/// Sum of cosines with whole-numbered wave vectors: smooth noise of period 1, standard deviation 1.
class PeriodicNoise {
 public:
  /// `waves` waves of `lowest` to `highest` cycles per period.
  PeriodicNoise(std::uint32_t seed, int waves, double lowest, double highest) {
    std::mt19937 random(seed);
    for (int i = 0; i < waves; ++i) {
      const double cycles = lowest + (highest - lowest) * uniform(random);
      const double angle_rad = kTwoPi * uniform(random);
      waves_.push_back({kTwoPi * std::round(cycles * std::cos(angle_rad)),
                        kTwoPi * std::round(cycles * std::sin(angle_rad)),
                        kTwoPi * uniform(random)});
    }
  }
  double operator()(double u, double v) const {
    double sum = 0;
    for (const Wave& wave : waves_) sum += std::cos(wave.u * u + wave.v * v + wave.phase);
    return sum * std::sqrt(2.0 / static_cast<double>(waves_.size()));
  }

 private:
  struct Wave {
    double u, v, phase;
  };
  std::vector<Wave> waves_;
};

// Rings of ornament around the centre, each inside its own smooth window.
double carving(double r, double angle_rad) {
  const auto window = [r](double inner, double outer) {
    return step(inner, inner + 0.008, r) * (1 - step(outer - 0.008, outer, r));
  };
  const double rosette = std::cos(8 * angle_rad) * r / 0.09;
  const double flutes = std::abs(std::cos(28 * angle_rad)) * r / 0.15;
  const double scrolls = std::cos(10 * angle_rad + 70 * kTwoPi * r * 0.3) *
                         std::cos(10 * angle_rad - 70 * kTwoPi * r * 0.3);
  const double bead_angle = wrapped(36 * angle_rad / kTwoPi) / 36 * kTwoPi * 0.375;
  const double bead = halfCircle(std::hypot(bead_angle, r - 0.375) / 0.03);
  const double rings = std::cos(kTwoPi * r / 0.016);
  return 0.012 * rosette * window(0.0, 0.09) + 0.010 * flutes * window(0.10, 0.19) +
         0.008 * scrolls * window(0.20, 0.33) + 0.022 * bead * window(0.335, 0.415) +
         0.0016 * rings * window(0.42, 0.48);
}

Height disk(std::uint32_t seed) {
  return [tool_marks = PeriodicNoise(seed, 24, 40, 90)](double u, double v) {
    const double x = u - 0.5, y = v - 0.5, r = std::hypot(x, y);
    const double angle_rad = std::atan2(y, x);
    const double marks = 4e-5 * tool_marks(u, v) * (1 - step(0.47, 0.49, r));
    const double rim = 0.01 * step(0.485, 0.49, r) * (1 - step(0.495, 0.4995, r));
    return carving(r, angle_rad) + marks + rim;
  };
}

// Every point belongs to the highest of the caps around it.
Height armour(std::uint32_t) {
  return [](double u, double v) {
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
  };
}

Height dunes(std::uint32_t seed) {
  return [slow = PeriodicNoise(seed, 12, 1, 5), bend = PeriodicNoise(seed + 1, 16, 2, 9),
          grains = PeriodicNoise(seed + 2, 24, 60, 120)](double u, double v) {
    constexpr int kRipples = 24;
    // Steep lee, gentle windward side: a cosine whose phase leans on itself.
    const double phase = kTwoPi * (kRipples * v + 3 * u) + 1.3 * bend(u, v);
    const double ripple = std::cos(phase + 0.6 * std::sin(phase));
    return 0.006 * slow(u, v) + 0.0035 * ripple + 1e-4 * grains(u, v);
  };
}

Height cloth(std::uint32_t seed) {
  return [unevenness = PeriodicNoise(seed, 16, 2, 30)](double u, double v) {
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
    return std::max(thread(u, v, 0), thread(v, u, 1)) + 4e-4 * unevenness(u, v);
  };
}

Height bumps(std::uint32_t seed) {
  return [coarse = PeriodicNoise(seed, 32, 10, 25), fine = PeriodicNoise(seed + 1, 48, 50, 110)](
             double u, double v) { return 1.2e-3 * coarse(u, v) + 4e-4 * fine(u, v); };
}

struct Generator {
  const char* kind;
  Height (*make)(std::uint32_t seed);
};

constexpr std::array kGenerators = {
    Generator{"flat", [](std::uint32_t) -> Height { return [](double, double) { return 0.0; }; }},
    Generator{"disk", disk},
    Generator{"armour", armour},
    Generator{"dunes", dunes},
    Generator{"cloth", cloth},
    Generator{"bumps", bumps}};

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
  const Height height = generator->make(recipe.seed);
  const int size = recipe.size_px;
  Image heights(size, size, 1);
  tbb::parallel_for(0, size, [&](int y) {
    for (int x = 0; x < size; ++x) {
      heights.at(x, y)[0] = static_cast<float>(height((x + 0.5) / size, (y + 0.5) / size));
    }
  });
  return heights;
}

NormalMap generateNormalMap(const NormalMapRecipe& recipe) {
  return normalsFromHeights(generateHeights(recipe), recipe.height_scale, recipe.kind);
}

}  // namespace glintmark
