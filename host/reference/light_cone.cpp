#include "host/reference/light_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/reference/beckmann.h"

namespace glintmark::reference {
namespace {

constexpr double kGolden = 0.6180339887498949;  // lattice generator of the azimuths

// Calls visit(direction) for `samples` directions of equal solid angle.
template <typename Visit>
void forEachDirection(const Cone& light, int samples, Visit&& visit) {
  const glm::dvec3 helper =
      std::abs(light.axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
  const glm::dvec3 side = glm::normalize(glm::cross(helper, light.axis));
  const glm::dvec3 other = glm::cross(light.axis, side);
  const double half_sin = std::sin(0.5 * light.half_angle_rad);
  for (int s = 0; s < samples; ++s) {
    // Equal solid angles are equal steps of 1 - cos = 2 sin^2(angle / 2).
    const double one_minus_cos = 2.0 * half_sin * half_sin * (s + 0.5) / samples;
    const double radius = std::sqrt(one_minus_cos * (2.0 - one_minus_cos));
    const double phi = 2.0 * std::numbers::pi * (s * kGolden - std::floor(s * kGolden));
    visit(light.axis * (1.0 - one_minus_cos) +
          (side * std::cos(phi) + other * std::sin(phi)) * radius);
  }
}

// Radiance times solid angle of a cone that gives irradiance 1 on a surface facing its axis:
// pi sin^2 L = 1, and the solid angle is 2 pi (1 - cos).
double powerOf(const Cone& light) {
  return 2.0 / (1.0 + std::cos(light.half_angle_rad));
}

// Calls visit(slope / alpha) for `samples` slopes of equal shares of a Beckmann lobe.
template <typename Visit>
void forEachSlope(int samples, Visit&& visit) {
  for (int s = 0; s < samples; ++s) {
    const double radius = std::sqrt(-std::log(1.0 - (s + 0.5) / samples));
    const double phi = 2.0 * std::numbers::pi * (s * kGolden - std::floor(s * kGolden));
    visit(glm::dvec2(radius * std::cos(phi), radius * std::sin(phi)));
  }
}

// Density over directions of the light that mirror o at slopes of the lobe: D (m . n) / (4 i . m).
double mirroredDensity(const glm::dvec3& i, const glm::dvec3& o, const glm::dvec2& alpha) {
  if (i.z <= 0) return 0;
  const glm::dvec3 m = glm::normalize(i + o);
  return ndf(m, alpha) * m.z / (4.0 * glm::dot(i, m));
}

double solidAngleOf(const Cone& light) {
  const double half_sin = std::sin(0.5 * light.half_angle_rad);
  return 4.0 * std::numbers::pi * half_sin * half_sin;
}

bool holds(const Cone& light, const glm::dvec3& i) {
  // |i - a| = 2 sin(angle / 2), without the cancellation of 1 - i . a.
  const glm::dvec3 d = i - light.axis;
  return glm::dot(d, d) <= 4.0 * std::pow(std::sin(0.5 * light.half_angle_rad), 2);
}

}  // namespace

glm::dvec3 coneRadiance(const Cone& light, const glm::dvec3& o, const glm::dvec2& alpha,
                        const glm::dvec3& f0, int samples) {
  if (light.half_angle_rad <= 0) return brdfTimesCosine(light.axis, o, alpha, f0);
  const double even = 1.0 / solidAngleOf(light);
  glm::dvec3 sum(0.0);
  const auto add = [&](const glm::dvec3& i) {
    if (i.z > 0) sum += brdfTimesCosine(i, o, alpha, f0) / (even + mirroredDensity(i, o, alpha));
  };
  forEachDirection(light, samples, add);
  forEachSlope(samples, [&](const glm::dvec2& y) {
    const glm::dvec3 m = glm::normalize(glm::dvec3(y * alpha, 1.0));
    const glm::dvec3 i = 2.0 * glm::dot(o, m) * m - o;
    if (glm::dot(o, m) > 0 && holds(light, i)) add(i);
  });
  return sum * (even * powerOf(light) / samples);
}

double coneDiffuse(const Cone& light, int samples) {
  double sum = 0;
  forEachDirection(light, samples, [&](const glm::dvec3& i) { sum += std::max(i.z, 0.0); });
  return sum * powerOf(light) / (std::numbers::pi * samples);
}

namespace {

// Half vectors of a cone as slopes in units of a microdetail's lobe, each with its area.
struct WeightedSlope {
  glm::dvec2 y;
  double area;
};

std::vector<WeightedSlope> halfVectorSlopes(const Cone& light, const glm::dvec3& o,
                                            const glm::dvec2& alpha, int samples) {
  std::vector<WeightedSlope> slopes;
  const double per_sample = solidAngleOf(light) / samples;
  forEachDirection(light, samples, [&](const glm::dvec3& i) {
    if (i.z <= 0) return;
    const glm::dvec3 m = glm::normalize(i + o);
    const double area = per_sample / (4.0 * glm::dot(i, m) * m.z * m.z * m.z);
    slopes.push_back({glm::dvec2(m.x, m.y) / m.z / alpha, area / (alpha.x * alpha.y)});
  });
  return slopes;
}

// Of a lobe within a cone: its mass, and the mean slope of that mass.
struct LobePart {
  double mass = 0;
  glm::dvec2 mean{0};  // in units of alpha
};

// Around slope `centre` / alpha. Cones narrower than the lobe are resolved by their own directions,
// wider ones by the lobe's slopes.
LobePart partWithin(const Cone& light, const glm::dvec3& o, const glm::dvec2& alpha,
                    const glm::dvec2& centre, const std::vector<WeightedSlope>& slopes,
                    int samples) {
  constexpr double kNarrowArea = 30;  // in units of alpha^2
  double area = 0;
  LobePart part;
  for (const WeightedSlope& s : slopes) {
    const glm::dvec2 d = s.y - centre;
    const double mass = s.area * std::exp(-glm::dot(d, d)) / std::numbers::pi;
    area += s.area;
    part.mass += mass;
    part.mean += mass * s.y;
  }
  if (area >= kNarrowArea) {
    part = {};
    forEachSlope(samples, [&](const glm::dvec2& y) {
      const glm::dvec3 m = glm::normalize(glm::dvec3((y + centre) * alpha, 1.0));
      const glm::dvec3 i = 2.0 * glm::dot(o, m) * m - o;
      if (glm::dot(o, m) <= 0 || i.z <= 0 || !holds(light, i)) return;
      part.mass += 1.0 / samples;
      part.mean += (y + centre) / static_cast<double>(samples);
    });
  }
  if (part.mass > 0) part.mean /= part.mass;
  return part;
}

}  // namespace

double coneProbability(const Cone& light, const glm::dvec3& o, const glm::dvec2& alpha_g,
                       const glm::dvec2& alpha_l, bool groove, int samples) {
  const LobePart all = partWithin(light, o, alpha_g, glm::dvec2(0.0),
                                  halfVectorSlopes(light, o, alpha_g, samples), samples);
  if (all.mass <= 0) return 0;
  const glm::dvec2 detail = groove ? glm::dvec2(alpha_g.x, alpha_l.y) : alpha_l;
  const glm::dvec2 free = groove ? glm::dvec2(0, 1) : glm::dvec2(1);
  const std::vector<WeightedSlope> slopes = halfVectorSlopes(light, o, detail, samples);
  glm::dvec2 centre = free * all.mean * alpha_g / detail;
  double best = 0;
  for (int step = 0; step < 12; ++step) {  // mean shift
    const LobePart part = partWithin(light, o, detail, centre, slopes, samples);
    best = std::max(best, part.mass);
    if (part.mass <= 0) break;
    centre += free * (part.mean - centre);
  }
  return best > 0 ? std::min(all.mass / best, 1.0) : 0.0;
}

}  // namespace glintmark::reference
