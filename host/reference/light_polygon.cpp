#include "host/reference/light_polygon.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "host/reference/polygon_light.h"

namespace glintmark::reference {
namespace {

constexpr double kLattice = 0.6180339887498949;  // fractions of multiples fill an interval evenly

struct SlopeArea {
  glm::dvec2 slope;
  double area;
};

// Area on the plane of slopes per solid angle of the light: d(half vector) = d(light) / (4 i . m),
// d(slope) = d(half vector) / m.z^3.
SlopeArea mirrorSlope(const glm::dvec3& i, const glm::dvec3& view, double solid_angle_sr) {
  const glm::dvec3 m = glm::normalize(i + view);
  return {glm::dvec2(m) / m.z, solid_angle_sr / (4 * glm::dot(i, m) * m.z * m.z * m.z)};
}

// Slopes of the light's half vectors: points of equal area on each triangle of its fan.
std::vector<SlopeArea> lightSlopes(std::span<const glm::dvec3> light, const glm::dvec3& view,
                                   int samples) {
  std::vector<SlopeArea> slopes;
  for (std::size_t k = 1; k + 1 < light.size(); ++k) {
    const glm::dvec3 a = light[0], ab = light[k] - a, bc = light[k + 1] - light[k];
    const glm::dvec3 across = glm::cross(ab, light[k + 1] - a);
    const double area = glm::length(across) / 2;
    for (int s = 0; s < samples && area > 0; ++s) {
      const double row = std::sqrt((s + 0.5) / samples);
      const double column = s * kLattice - std::floor(s * kLattice);
      const glm::dvec3 place = a + row * (ab + column * bc);
      const double distance = glm::length(place);
      const glm::dvec3 i = place / distance;
      if (i.z <= 0) continue;
      const double facing = std::abs(glm::dot(i, across)) / (2 * area);
      slopes.push_back(mirrorSlope(i, view, area / samples * facing / (distance * distance)));
    }
  }
  return slopes;
}

bool holds(std::span<const glm::dvec3> light, const glm::dvec3& i) {
  double least = 0, most = 0;
  for (std::size_t k = 0; k < light.size(); ++k) {
    const double side = glm::dot(glm::cross(light[k], light[(k + 1) % light.size()]), i);
    least = std::min(least, side);
    most = std::max(most, side);
  }
  glm::dvec3 middle(0);
  for (const glm::dvec3& v : light) middle += glm::normalize(v);
  return (least == 0 || most == 0) && glm::dot(middle, i) > 0;
}

// Density over slopes, in units of alpha.
double lobeDensity(Ndf ndf, const glm::dvec2& y) {
  const double r_sq = glm::dot(y, y);
  return (ndf == Ndf::kGgx ? 1 / ((1 + r_sq) * (1 + r_sq)) : std::exp(-r_sq)) / std::numbers::pi;
}

// What lies within a lobe's share of `u`, 0 to 1, as a radius in units of alpha.
double lobeRadius(Ndf ndf, double u) {
  return std::sqrt(ndf == Ndf::kGgx ? u / (1 - u) : -std::log(1 - u));
}

struct PolygonPart {
  double mass = 0;
  glm::dvec2 mean{0};  // slope
};

// Of a lobe of roughness `alpha` around slope `centre`, what mirrors the light. Lights narrower
// than the lobe are resolved by their own directions, wider ones by the lobe's slopes.
PolygonPart partWithin(std::span<const glm::dvec3> light, const std::vector<SlopeArea>& slopes,
                       const glm::dvec3& view, Ndf ndf, const glm::dvec2& alpha,
                       const glm::dvec2& centre, int samples) {
  constexpr double kNarrowArea = 10;  // in units of alpha^2
  double area = 0;
  PolygonPart part;
  for (const SlopeArea& one : slopes) {
    const double own = one.area / (alpha.x * alpha.y);
    const double mass = own * lobeDensity(ndf, (one.slope - centre) / alpha);
    area += own;
    part.mass += mass;
    part.mean += mass * one.slope;
  }
  if (area >= kNarrowArea) {
    part = {};
    for (int s = 0; s < samples; ++s) {
      const double radius = lobeRadius(ndf, (s + 0.5) / samples);
      const double turn = 2 * std::numbers::pi * (s * kLattice - std::floor(s * kLattice));
      const glm::dvec2 slope = centre + alpha * radius * glm::dvec2(std::cos(turn), std::sin(turn));
      const glm::dvec3 m = glm::normalize(glm::dvec3(slope, 1));
      const glm::dvec3 i = 2 * glm::dot(view, m) * m - view;
      if (glm::dot(view, m) <= 0 || i.z <= 0 || !holds(light, i)) continue;
      part.mass += 1.0 / samples;
      part.mean += slope / static_cast<double>(samples);
    }
  }
  if (part.mass > 0) part.mean /= part.mass;
  return part;
}

}  // namespace

double polygonProbability(std::span<const glm::dvec3> vertices, const glm::dvec3& view,
                          const DetailLobes& lobes, int samples) {
  const std::vector<glm::dvec3> light = clipPolygon(vertices, {0, 0, 1});
  if (light.size() < 3) return 0;
  const std::vector<SlopeArea> slopes = lightSlopes(light, view, samples);
  const PolygonPart all =
      partWithin(light, slopes, view, lobes.ndf, glm::dvec2(lobes.alpha_g), glm::dvec2(0), samples);
  if (all.mass <= 0) return 0;
  glm::dvec2 centre = all.mean;
  double best = 0;
  for (int step = 0; step < 12; ++step) {  // mean shift
    const PolygonPart part =
        partWithin(light, slopes, view, Ndf::kBeckmann, lobes.alpha_l, centre, samples);
    best = std::max(best, part.mass);
    if (part.mass <= 0) break;
    centre = part.mean;
  }
  return best > 0 ? std::min(all.mass / best, 1.0) : 0;
}

double pointShare(const glm::dvec3& direction, double solid_angle_sr, const glm::dvec3& view,
                  const DetailLobes& lobes) {
  const SlopeArea one = mirrorSlope(direction, view, solid_angle_sr);
  return lobeDensity(lobes.ndf, one.slope / lobes.alpha_g) * one.area /
         (lobes.alpha_g * lobes.alpha_g);
}

}  // namespace glintmark::reference
