// [KPT25]: particles in four dimensions, summed by their Gaussians. With Beckmann's map.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/reference/pixel_ellipse.h"
#include "host/reference/rivals.h"
#include "host/reference/seeds.h"

namespace glintmark::reference {
namespace {

constexpr double kPixelSigma = 0.7;
constexpr int kLeastLevel = 1, kMostLevel = 18;
constexpr double kPi = std::numbers::pi;

double normalShare(double x) {  // of a normal distribution, below x
  return 0.5 * std::erfc(-x / std::numbers::sqrt2);
}

// One axis of slopes: where the half vector lies, and how wide a particle's Gaussian is.
struct SlopeAxis {
  double at = 0.5, sigma = 0;
  bool flat = false;  // grooves along u

  double between(double low, double high) const {
    if (flat) return high - low;
    return normalShare((high - at) / sigma) - normalShare((low - at) / sigma);
  }
  double gaussian(double from) const {  // 1 at its middle
    return flat ? 1 : std::exp(-0.5 * from * from / (sigma * sigma));
  }
};

// Of a Beckmann lobe, whose slopes have the variance alpha^2 / 2: the map moves a step of slopes by
// the density, and with it the lobe of a microdetail.
SlopeAxis beckmannAxis(double slope, double alpha_g, double alpha_l) {
  const double density = std::exp(-std::pow(slope / alpha_g, 2)) / (std::sqrt(kPi) * alpha_g);
  return {normalShare(std::numbers::sqrt2 * slope / alpha_g),
          density * alpha_l / std::numbers::sqrt2};
}

std::uint32_t particleSeed(std::int32_t x, std::int32_t y, int level, std::int32_t a,
                           std::int32_t b) {
  std::uint32_t s = static_cast<std::uint32_t>(x) * 0x9E3779B1u +
                    static_cast<std::uint32_t>(y) * 0x85EBCA77u +
                    static_cast<std::uint32_t>(level) * 0x632BE5ABu;
  s ^= s >> 16;
  s *= 0x7FEB352Du;
  s ^= s >> 15;
  s ^= static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b) * 0x01000193u;
  s *= 0x846CA68Bu;
  s ^= s >> 15;
  s *= 0xC2B2AE3Du;
  return s ^ (s >> 16);
}

glm::dvec2 jitterOf(std::uint32_t h) {
  return {(h & 0xFFFFu) / 65536.0, static_cast<double>(h >> 16) / 65536.0};
}

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Pixels per uv along both axes of the screen.
struct ToPixels {
  glm::dvec2 x{}, y{};

  double gaussian(const glm::dvec2& from_uv) const {
    const double a = glm::dot(x, from_uv), b = glm::dot(y, from_uv);
    return std::exp(-0.5 * (a * a + b * b) / (kPixelSigma * kPixelSigma));
  }
};

struct ParticleQuery {
  const PixelFootprint& footprint;
  LatticeMatrix matrix;
  int exponent = 0;   // of the particles per unit of uv
  double per_uv = 0;  // which these are
  ToPixels to_pixels;
  SlopeAxis u, v;
};

std::int32_t middleOf(double at, double cells) {
  return static_cast<std::int32_t>(std::clamp(std::round(at * cells), 1.0, cells - 1));
}

// The sum over the particles of one level, Gaussians 1 at their middles.
double levelSum(const ParticleQuery& q, int level, double weight) {
  const LatticeCell cell = latticeCell(q.footprint, level - q.exponent, q.matrix);
  const double cells = std::exp2(level);
  const std::int32_t first_a = middleOf(q.u.at, cells) - 1, first_b = middleOf(q.v.at, cells) - 1;
  const int first_x = cell.within.x < 0.5 ? -1 : 0, first_y = cell.within.y < 0.5 ? -1 : 0;
  double sum = 0;
  for (int i = 0; i < 16; ++i) {
    const int x = first_x + i % 2, y = first_y + i / 2 % 2;
    const std::int32_t a = first_a + i / 4 % 2, b = first_b + i / 8;
    const std::uint32_t h = particleSeed(wrapped(std::int64_t{cell.x} + x),
                                         wrapped(std::int64_t{cell.y} + y), level, a, b);
    const glm::dvec2 place = jitterOf(h * 0x2C1B3C6Du), slope = jitterOf(h * 0x297A2D39u);
    const double r = uniformOf(h * 0x1B56C4E9u);
    const glm::dvec2 from_uv = (glm::dvec2(x, y) + place - cell.within) * (cells / q.per_uv);
    sum += smoothstep(std::max(r - 0.1, 0.0), std::min(r + 0.1, 1.0), weight) *
           q.to_pixels.gaussian(from_uv) * q.u.gaussian((a + slope.x) / cells - q.u.at) *
           q.v.gaussian((b + slope.y) / cells - q.v.at);
  }
  return sum;
}

// What the Gaussians have beyond the cells of slopes that are summed.
double levelRest(const ParticleQuery& q, int level) {
  const double cells = std::exp2(level);
  double contained = 1, summed = 1;
  for (const SlopeAxis* axis : {&q.u, &q.v}) {
    const double middle = middleOf(axis->at, cells);
    contained *= axis->between(0, 1);
    summed *= axis->between((middle - 1) / cells, (middle + 1) / cells);
  }
  return std::max(contained - summed, 0.0);
}

}  // namespace

RivalRatio kemppinen(const PixelFootprint& footprint, const Glints& glints,
                     const RivalLight& light) {
  const PixelEllipse ellipse = pixelEllipse(footprint);
  const double root = std::sqrt(glints.density);
  const int exponent = std::ilogb(root);
  const int mantissa =
      std::min(static_cast<int>(std::floor(std::ldexp(root, 14 - exponent) + 0.5)), 32767);
  ParticleQuery q = {footprint, {mantissa, 0, 0, mantissa}, exponent, 0, {}, {}, {}};
  q.per_uv = std::ldexp(mantissa, exponent - 14);
  const glm::dvec2 x = footprint.duv_dx, y = footprint.duv_dy;
  const double area = ellipse.longer * ellipse.shorter;
  const double determinant = x.x * y.y - y.x * x.y < 0 ? -area : area;
  q.to_pixels = {glm::dvec2(y.y, -y.x) / determinant, glm::dvec2(-x.y, x.x) / determinant};

  const glm::dvec2 slope = glm::dvec2(light.half) / light.half.z;
  q.u = beckmannAxis(slope.x, glints.alpha_g.x, glints.alpha_l.x);
  q.v = beckmannAxis(slope.y, glints.alpha_g.y, glints.alpha_l.y);
  if (glints.groove) q.u = {0.5, 1 / std::sqrt(2 * kPi), true};
  const double lod =
      std::clamp(std::log2(ellipse.longer * q.per_uv * kPixelSigma) + std::exp2(kPixelSigma),
                 static_cast<double>(kLeastLevel), static_cast<double>(kMostLevel));
  const auto level = static_cast<int>(lod);
  const double upper = lod - level;

  const double peaks = 2 * kPi * q.u.sigma * q.v.sigma * 2 * kPi * kPixelSigma * kPixelSigma *
                       area * q.per_uv * q.per_uv;
  RivalRatio result = {0, 32, false};
  result.ratio = (levelSum(q, level, 1 - upper) + levelSum(q, level + 1, upper)) / peaks +
                 (1 - upper) * levelRest(q, level) + upper * levelRest(q, level + 1);
  return result;
}

}  // namespace glintmark::reference
