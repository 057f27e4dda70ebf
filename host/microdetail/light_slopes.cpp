#include "host/microdetail/light_slopes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/core/error.h"

namespace glintmark {
namespace {

double lobe(const glm::dvec2& slope, const glm::dvec2& alpha) {
  const glm::dvec2 x = slope / alpha;
  return std::exp(-glm::dot(x, x));
}

struct WeightedSlope {
  glm::dvec2 slope;
  double area;
};

// Directions of a spiral over the cone, as the slopes of their half vectors, each with its area on
// the plane of slopes: dx = d(half vector) / z^3 and d(half vector) = d(light) / (4 i . m).
std::vector<WeightedSlope> slopesOf(const reference::Cone& light, const glm::dvec3& view,
                                    int samples) {
  const glm::dvec3 aside = std::abs(light.axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(light.axis, aside)), v = glm::cross(light.axis, u);
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  const double depth = 1 - std::cos(light.half_angle_rad);
  std::vector<WeightedSlope> slopes;
  for (int s = 0; s < samples; ++s) {
    const double z = 1 - depth * (s + 0.5) / samples, r = std::sqrt(1 - z * z);
    const glm::dvec3 i =
        z * light.axis + r * (std::cos(s * golden_angle) * u + std::sin(s * golden_angle) * v);
    if (i.z <= 0) continue;
    const glm::dvec3 m = glm::normalize(i + view);
    slopes.push_back({glm::dvec2(m) / m.z, 1 / (4 * glm::dot(i, m) * m.z * m.z * m.z)});
  }
  return slopes;
}

// What a microdetail of slope `at` mirrors, and the mean slope of that.
WeightedSlope mirrored(const std::vector<WeightedSlope>& slopes, const glm::dvec2& at,
                       const glm::dvec2& alpha) {
  WeightedSlope sum{glm::dvec2(0), 0};
  for (const WeightedSlope& one : slopes) {
    const double share = one.area * lobe(one.slope - at, alpha);
    sum.area += share;
    sum.slope += share * one.slope;
  }
  if (sum.area > 0) sum.slope /= sum.area;
  return sum;
}

// The most that a microdetail can mirror. The slopes of a cone are a convex set, which a Gaussian
// smooths to one hill: a climb from its middle, from mean to mean, ends at the top.
double mostMirrored(const std::vector<WeightedSlope>& slopes, const glm::dvec2& alpha) {
  glm::dvec2 at(0);
  double area = 0;
  for (const WeightedSlope& one : slopes) {
    at += one.area * one.slope;
    area += one.area;
  }
  at /= area;
  double best = 0;
  for (int step = 0; step < 100; ++step) {
    const WeightedSlope here = mirrored(slopes, at, alpha);
    best = std::max(best, here.area);
    if (here.area <= 0 || glm::length((here.slope - at) / alpha) < 1e-6) break;
    at = here.slope;
  }
  return best;
}

}  // namespace

LightSlopes pointSlopes(const glm::dvec2& half_slope, const glm::dvec2& alpha_g,
                        const glm::dvec2& alpha_l) {
  const double p = alpha_l.x * alpha_l.y / (alpha_g.x * alpha_g.y) * lobe(half_slope, alpha_g);
  return {{{static_cast<float>(half_slope.x), static_cast<float>(half_slope.y), 1, 0}}, p};
}

LightSlopes coneSlopes(const reference::Cone& light, const glm::dvec3& view,
                       const glm::dvec2& alpha_g, const glm::dvec2& alpha_l, int samples) {
  const std::vector<WeightedSlope> slopes = slopesOf(light, view, samples);
  if (slopes.empty()) throw Error("the cone of light is below the horizon; none of it is mirrored");
  const double best = mostMirrored(slopes, alpha_l);
  LightSlopes made;
  for (const WeightedSlope& one : slopes) {
    const double weight = one.area / best;
    made.taps.push_back({static_cast<float>(one.slope.x), static_cast<float>(one.slope.y),
                         static_cast<float>(weight), 0});
    made.probability +=
        weight * alpha_l.x * alpha_l.y / (alpha_g.x * alpha_g.y) * lobe(one.slope, alpha_g);
  }
  return made;
}

}  // namespace glintmark
