// The shader that [ZK16]'s authors published, by its behaviour.
#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "host/reference/rivals.h"

namespace glintmark::reference {
namespace {

constexpr int kMostSteps = 18;
constexpr double kAnisotropy = 16, kOffset = 100, kDynamicRange = 50000;

double sineHash(float n) {
  return publishedHash(n);
}

// Of numbers between -edge and edge: the normal quantile over the root of 2, by bisection.
double erfInverse(double uniform, double edge) {
  const double x = edge * (2 * uniform - 1);
  double low = -6, high = 6;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (std::erf(middle) < x ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::int32_t sharedIndex(std::int32_t i) {
  if (i > 0) return i >> std::countr_zero(static_cast<std::uint32_t>(i));
  while (i % 2 != 0) i /= 2;  // C's division, towards 0
  return i;
}

// Inverts the sum of one distribution: the first term that passes u, or what the tail says.
struct Inversion {
  double p, term, sum, k;

  Inversion(double p_, double n) : p(p_), term(std::pow(1 - p_, n)), sum(term), k(n) {}
  void add(double n, int i) {
    term *= p / (1 - p) * (n + 1 - i) / i;
    sum += term;
  }
};

double binomial(double u, double n_real, double p_real) {
  if (p_real >= 1) return n_real;
  if (p_real <= 1e-30) return 0;
  const double n = std::ceil(n_real), p = p_real * n_real / n;
  const double power = std::log(p) / std::log(0.9), below = std::floor(power);
  const double p_high = std::pow(0.9, below);
  Inversion low(0.9 * p_high, n), high(p_high, n);
  for (int i = 0; p_high < 1; ++i) {
    if (i > 0) {
      low.add(n, i);
      high.add(n, i);
    }
    if (u < low.sum) low.k = std::min<double>(low.k, i);
    if (u < high.sum) {
      high.k = i;
      break;
    }
    if (i < 17) continue;
    const auto tail = [&](Inversion& one) {
      const double beyond = (u - one.sum) / (1 - one.sum);
      const double k = i + 1 + std::log(1 - beyond * (1 - std::pow(p, n - i - 1))) / std::log(p);
      one.k = std::min(one.k, k);
    };
    tail(low);
    tail(high);
    break;
  }
  return high.k + (power - below) * (low.k - high.k);
}

double draw(double u, double n, double p) {
  const double mean = n * p;
  if (mean <= 5) return binomial(u, n, p);
  return std::clamp(mean + erfInverse(u, 0.999999) * std::sqrt(mean * std::max(1 - p, 0.0)), 0.0,
                    n);
}

struct CellLight {
  double p = 0;
  glm::dvec2 half{};  // in cells of the half vector's grid
};

float asFloat(std::uint32_t sum) {
  return static_cast<float>(static_cast<std::int32_t>(sum));
}

double cellShare(std::int32_t u, std::int32_t v, int level, const Glints& glints,
                 const CellLight& light) {
  const auto i_u = static_cast<std::uint32_t>(sharedIndex(u));
  const auto i_v = static_cast<std::uint32_t>(sharedIndex(v));
  const float n = asFloat(i_u + 1549u * i_v);
  const double r_u = sineHash(n), r_v = sineHash(n + 1.1f);
  const auto j_u = static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::floor(light.half.x + r_u) + r_u * 533));
  const auto j_v = static_cast<std::uint32_t>(
      static_cast<std::int32_t>(std::floor(light.half.y + r_v) + r_v * 533));
  double expected = std::ldexp(glints.density, 2 * level), count = expected;
  if (glints.size_variation > 0) {
    const double varied = sineHash(asFloat(i_u + 763u * i_v + j_u + 577u * j_v));
    double size = 1 + glints.size_variation * erfInverse(varied, 0.999);
    if (size <= 0) size = (size - std::floor(size)) / (1 - size);
    size = std::max(size, 1e-12);
    count = std::max(expected * size, std::min(1.0, expected));
    expected *= size;
  }
  const double k = draw(sineHash(asFloat(j_u + 697u * j_v)), count, light.p);
  return std::min(k / expected, kDynamicRange * light.p);
}

// One grid. x is the long axis.
struct Walk {
  glm::dvec2 centre{};  // from the corner of cell (base_x, base_y)
  std::int32_t base_x = 0, base_y = 0;
  double length = 0, skew = 0;
  bool swapped = false;
  int level = 0;
};

Walk walkOf(const PixelFootprint& footprint, const glm::dvec2& stretch, int level) {
  const auto split = [&](FixedCoordinate c, double scale, std::int32_t& base) {
    const long double position =
        std::ldexp((static_cast<long double>(c.integer) + kOffset +
                    std::ldexp(static_cast<long double>(c.fraction), -32)) *
                       scale,
                   -level);
    const long double whole = std::floor(position);
    base = wrapped(static_cast<std::int64_t>(whole));
    return static_cast<double>(position - whole);
  };
  Walk w;
  w.level = level;
  w.centre.x = split(footprint.u, stretch.x, w.base_x);
  w.centre.y = split(footprint.v, stretch.y, w.base_y);
  const glm::dvec2 box = glm::max(glm::abs(footprint.duv_dx), glm::abs(footprint.duv_dy)) * stretch;
  w.swapped = box.x <= box.y;
  w.length = std::ldexp(std::max(box.x, box.y), -level);
  // Pixels over uv: rows x and y of the inverse, but for the determinant.
  const glm::dvec2 dx = footprint.duv_dx, dy = footprint.duv_dy;
  const int l = w.swapped ? 1 : 0, s = 1 - l;
  const glm::dvec2 px(dy.y, -dy.x), py(-dx.y, dx.x);
  const glm::dvec2& row = std::abs(px[s]) > std::abs(py[s]) ? px : py;
  w.skew = row[s] != 0 ? -row[l] / row[s] * stretch[s] / stretch[l] : 0;
  if (w.swapped) {
    std::swap(w.centre.x, w.centre.y);
    std::swap(w.base_x, w.base_y);
  }
  return w;
}

double gridShare(const Walk& w, const Glints& glints, const CellLight& light, RivalRatio& result) {
  const double begin = w.centre.x + std::min(0.5 - 0.5 * w.length, 0.0);
  const double end = w.centre.x + std::max(0.5 * w.length - 0.5, 0.0);
  double sum = 0, weights = 0;
  for (int i = 0;; ++i) {
    const double at = std::floor(begin) + i;
    if (at >= end + 1) break;
    if (i == kMostSteps) {
      result.limited = true;
      break;
    }
    const double along =
        std::max(1 - std::max(begin - at, 0.0), 0.0) * std::max(1 - std::max(at - end, 0.0), 0.0);
    const double across = w.centre.y + w.skew * (at - w.centre.x), below = std::floor(across);
    for (int side = 0; side < 2; ++side) {
      const std::int32_t x = wrapped(w.base_x + static_cast<std::int64_t>(at));
      const std::int32_t y = wrapped(w.base_y + static_cast<std::int64_t>(below) + side);
      const double weight = along * (side == 0 ? 1 - (across - below) : across - below);
      sum += weight * cellShare(w.swapped ? y : x, w.swapped ? x : y, w.level, glints, light);
      weights += weight;
      ++result.visited;
    }
  }
  return sum / weights;
}

}  // namespace

// In single precision, as the shader says: what is lost there makes up the hash.
double publishedHash(float n) {
  const float before = 3.14f * std::floor(n / 3.14f);
  const float rest = n - before;
  const auto sine = static_cast<float>(std::sin(static_cast<double>(rest)));
  const float value = sine * 753.5453123f;
  return value - std::floor(value);
}

RivalRatio publishedZk16(const PixelFootprint& footprint, const Glints& glints,
                         const RivalLight& light) {
  const glm::dvec2 stretch = gridRules(glints.alpha_g, glints.alpha_l, glints.density).stretch;
  const glm::dvec2 dx = footprint.duv_dx, dy = footprint.duv_dy;
  const glm::dvec2 box = glm::max(glm::abs(dx), glm::abs(dy)) * stretch;
  const double area = footprintArea(footprint);
  const glm::dvec2 chord(area / std::max({std::abs(dy.y), std::abs(dx.y), 0x1p-28}),
                         area / std::max({std::abs(dy.x), std::abs(dx.x), 0x1p-28}));
  const double size =
      std::max(box.x > box.y ? chord.y : chord.x, std::max(box.x, box.y) / kAnisotropy);
  const double lod = std::clamp(std::log2(std::max(size, 0x1p-29)), -30.0, 29.0);
  const auto level = static_cast<int>(std::floor(lod));

  const double lobe = light.probability / std::pow(light.half.z, 4);
  CellLight cell_light = {std::min(lobe, 1.0), {}};
  cell_light.half = 0.75 * glm::dvec2(light.half) / (1 + light.half.z) * stretch / glints.alpha_l;
  if (glints.groove) cell_light.half.x = 0;
  RivalRatio result;
  const double upper = lod - level;
  const double share =
      (1 - upper) * gridShare(walkOf(footprint, stretch, level), glints, cell_light, result) +
      upper * gridShare(walkOf(footprint, stretch, level + 1), glints, cell_light, result);
  result.ratio = share / lobe;
  return result;
}

}  // namespace glintmark::reference
