// [DB23]: four grids around a pixel in a space of angle, ratio and level, and gated Gaussians.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/reference/pixel_ellipse.h"
#include "host/reference/rivals.h"
#include "host/reference/seeds.h"

namespace glintmark::reference {
namespace {

constexpr double kHalfScreenScale = 0.75;
constexpr int kMostRatio = 16;
constexpr double kMostOfPeak = 20;

// A grid: cells of 2^level across, `ratio` times as long along `angle` in 8 * ratio-ths of a turn.
struct AnisoGrid {
  int level = 0, ratio = 1, angle = 0;
  glm::dvec3 at{};  // its corner in the space of angle, ratio and level
  double weight = 0;
};

struct Corner {
  glm::dvec2 at{};
  int ratio = 1, angle = 0;
};

// Coordinates of a point in a tetrahedron, by volumes.
std::array<double, 4> barycentric(const std::array<AnisoGrid, 4>& corner, const glm::dvec3& p) {
  const auto volume = [](const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c,
                         const glm::dvec3& d) { return glm::dot(b - a, glm::cross(c - a, d - a)); };
  const glm::dvec3 &a = corner[0].at, &b = corner[1].at, &c = corner[2].at, &d = corner[3].at;
  const double whole = volume(a, b, c, d);
  return {volume(p, b, c, d) / whole, volume(a, p, c, d) / whole, volume(a, b, p, d) / whole,
          volume(a, b, c, p) / whole};
}

// The triangles between a ratio and the next: angles are twice as fine there, and have no meaning
// for round cells. Each in the order in which its prism is cut.
std::vector<std::array<Corner, 3>> triangles(int ratio, int angle) {
  if (ratio == 1) {
    const Corner centre = {{0, 0}, 1, 0}, left = {{0, 1}, 2, angle % 8},
                 right = {{1, 1}, 2, (angle + 1) % 8};
    return {{left, right, centre}};
  }
  const int coarse = 4 * ratio, fine = 8 * ratio;
  const Corner left = {{0, 0}, ratio, angle % coarse},
               right = {{1, 0}, ratio, (angle + 1) % coarse};
  const Corner above_left = {{0, 1}, 2 * ratio, 2 * angle % fine};
  const Corner above = {{0.5, 1}, 2 * ratio, (2 * angle + 1) % fine};
  const Corner above_right = {{1, 1}, 2 * ratio, (2 * angle + 2) % fine};
  return {{above_left, above, left}, {above, left, right}, {above, above_right, right}};
}

AnisoGrid gridOf(const Corner& corner, int level, bool upper) {
  return {level + (upper ? 1 : 0), corner.ratio, corner.angle,
          glm::dvec3(corner.at, upper ? 1.0 : 0.0), 0};
}

// The grids around a point of that space: the tetrahedron that holds it.
std::array<AnisoGrid, 4> gridsAround(int ratio, int angle, int level, const glm::dvec3& point) {
  std::array<AnisoGrid, 4> best{};
  double deepest = -1e30;
  for (const std::array<Corner, 3>& c : triangles(ratio, angle))
    for (int cut = 0; cut < 3; ++cut) {
      // Corners up to the cut below, from it on above.
      std::array<AnisoGrid, 4> grids;
      for (std::size_t i = 0; i < 4; ++i) {
        const bool upper = static_cast<int>(i) > cut;
        grids[i] = gridOf(c[upper ? i - 1 : i], level, upper);
      }
      const std::array<double, 4> weights = barycentric(grids, point);
      const double least = *std::ranges::min_element(weights);
      if (least <= deepest) continue;
      deepest = least;
      for (std::size_t i = 0; i < 4; ++i) grids[i].weight = std::max(weights[i], 0.0);
      best = grids;
    }
  return best;
}

int entry(double x) {
  return static_cast<int>(std::floor(x * 16384 + 0.6875));
}

// "The draws of rivals": a cell's seed.
std::uint32_t seedOf(const AnisoGrid& grid, std::int32_t x, std::int32_t y) {
  const auto log_ratio = static_cast<int>(std::log2(grid.ratio));
  std::uint32_t s =
      static_cast<std::uint32_t>(x) * 0x9E3779B1u + static_cast<std::uint32_t>(y) * 0x85EBCA77u +
      static_cast<std::uint32_t>((grid.level * 8 + log_ratio) * 256 + grid.angle) * 0x632BE5ABu;
  s ^= s >> 16;
  s *= 0x7FEB352Du;
  return s ^ (s >> 15);
}

struct Draws {
  double p = 0;
  HalfVectorIndex slope;  // among the taps, 16.16
  bool as_published = true;
};

double drawOne(std::uint32_t seed, std::int32_t j_u, std::int32_t j_v, double n,
               const Draws& draws) {
  // pairSeed() shifts by the seed; the tap's own index is wanted here.
  std::uint32_t d =
      seed ^ (static_cast<std::uint32_t>(j_u) + static_cast<std::uint32_t>(j_v) * 0x01000193u);
  d *= 0x846CA68Bu;
  d ^= d >> 15;
  d *= 0xC2B2AE3Du;
  d ^= d >> 16;
  const double p = draws.p, u = uniformOf(d), z = gaussOf(d * 0x2C1B3C6Du);
  const double some = p < 1 ? -std::expm1(n * std::log1p(-p)) : n > 0 ? 1 : 0;
  const double mean = (n - 1) * p, sigma = std::sqrt(std::max(mean * (1 - p), 0.0));
  if (!draws.as_published) {
    const double gate = n < 1 ? n * p : some;
    return u < gate ? std::clamp(1 + mean + sigma * z, 1.0, std::max(n, 1.0)) : 0;
  }
  const double ramp = 0.1 * std::min(std::min(some, 1 - some) * 10, 1.0);
  const double open =
      ramp > 1e-7 ? std::clamp((some + ramp - u) / (2 * ramp), 0.0, 1.0) : (u < some ? 1.0 : 0.0);
  return open * (1 + std::clamp(std::floor(mean + sigma * z), 0.0, n));
}

// A cell's four taps around the half vector.
double cellDraw(std::uint32_t seed, double n, const Draws& draws) {
  const std::int64_t u = draws.slope.u + static_cast<std::int64_t>(seed & 0xFFFFu) * 64;
  const std::int64_t v = draws.slope.v + static_cast<std::int64_t>(seed >> 16) * 64;
  const std::int32_t j_u = wrapped(u) >> 16, j_v = wrapped(v) >> 16;
  const double s = static_cast<double>(u & 0xFFFF) / 65536;
  const double t = static_cast<double>(v & 0xFFFF) / 65536;
  return (1 - s) * (1 - t) * drawOne(seed, j_u, j_v, n, draws) +
         s * (1 - t) * drawOne(seed, j_u + 1, j_v, n, draws) +
         (1 - s) * t * drawOne(seed, j_u, j_v + 1, n, draws) +
         s * t * drawOne(seed, j_u + 1, j_v + 1, n, draws);
}

// What one grid adds to the share that reflects: the triangle of cells around the pixel.
double gridShare(const PixelFootprint& footprint, const AnisoGrid& grid, const Glints& glints,
                 const Draws& draws) {
  const double turn = 2 * std::numbers::pi * grid.angle / (8.0 * grid.ratio);
  const glm::dvec2 along =
      glm::dvec2(std::cos(turn), std::sin(turn)) / static_cast<double>(grid.ratio);
  const glm::dvec2 across(-std::sin(turn), std::cos(turn));
  const glm::dvec2 x = across - along / std::sqrt(3.0), y = along * (2 / std::sqrt(3.0));
  const LatticeCell cell =
      latticeCell(footprint, grid.level, {entry(x.x), entry(x.y), entry(y.x), entry(y.y)});
  const double mean = std::ldexp(glints.density * grid.ratio, 2 * grid.level);
  const double log_sigma = std::sqrt(std::log1p(glints.size_variation * glints.size_variation));
  double share = 0;
  for (int dx = 0; dx < 2; ++dx)
    for (int dy = 0; dy < 2; ++dy) {
      // Linear on either half of the square.
      const double a = dx == 1 ? cell.within.x : 1 - cell.within.x;
      const double b = dy == 1 ? cell.within.y : 1 - cell.within.y;
      const double beta = dx == dy ? std::max(a + b - 1, 0.0) : std::min(a, b);
      if (beta <= 0) continue;
      const std::uint32_t seed =
          seedOf(grid, wrapped(std::int64_t{cell.x} + dx), wrapped(std::int64_t{cell.y} + dy));
      const double n = mean * std::exp(log_sigma * gaussOf(seed * 0x297A2D39u));
      share += beta * cellDraw(seed, n * grid.weight, draws) / n;
    }
  return share;
}

}  // namespace

RivalRatio deliotBelcour(const PixelFootprint& footprint, const Glints& glints,
                         const RivalLight& light, bool as_published) {
  PixelEllipse ellipse = pixelEllipse(footprint);
  RivalRatio result = {0, 48, ellipse.longer > 1.0001 * kMostRatio * ellipse.shorter};
  ellipse.shorter = std::max(ellipse.shorter, ellipse.longer / kMostRatio);
  const double axes = ellipse.longer / ellipse.shorter;
  int ratio = 1;
  while (ratio < kMostRatio && axes >= 2 * ratio) ratio *= 2;
  const double angles = ellipse.angle / std::numbers::pi * 4 * std::max(ratio, 2);
  const auto angle = static_cast<int>(angles);
  const double lod = std::log2(ellipse.shorter * kHalfScreenScale);
  const double below = std::floor(lod);
  const double t = angles - angle, r = std::min(axes / ratio - 1, 1.0);
  const auto level = static_cast<int>(as_published ? std::trunc(lod) : below);

  Draws draws = {light.probability, {}, as_published};
  const glm::dvec2 tap = 65536.0 * glm::abs(glm::dvec2(light.half)) / glints.alpha_l;
  draws.slope = {glints.groove ? 0 : static_cast<std::int32_t>(tap.x),
                 static_cast<std::int32_t>(tap.y)};
  double share = 0;
  for (const AnisoGrid& grid :
       gridsAround(ratio, angle, level, {ratio == 1 ? r * t : t, r, lod - below}))
    share += gridShare(footprint, grid, glints, draws);
  if (as_published) {
    const glm::dvec2 peak = glints.alpha_l / glints.alpha_g;
    share = std::min(
        share, kMostOfPeak * std::max(glints.groove ? peak.y : peak.x * peak.y, light.probability));
  }
  result.ratio = share / light.probability;
  return result;
}

}  // namespace glintmark::reference
