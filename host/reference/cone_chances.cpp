#include "host/reference/cone_chances.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace glintmark::reference {
namespace {

constexpr int kConeDirections = 600;
constexpr int kConeNodes = 192;    // a side, of slopes from -kMostSlope to kMostSlope
constexpr double kDeviations = 4;  // of slopes that are looked up
constexpr double kSpiralStep = 0.6180339887498949;

// Chances of one light over the plane of slopes.
struct ChanceMap {
  std::vector<float> chance;  // kConeNodes x kConeNodes
  double share = 0;
};

// Where slopes stand among the nodes.
struct SlopeNodes {
  double most = 1;  // slope

  double at(int node) const { return most * (2.0 * node / (kConeNodes - 1) - 1); }
  double position(double slope) const {
    return std::clamp((slope / most + 1) * 0.5 * (kConeNodes - 1), 0.0, kConeNodes - 1.001);
  }
};

// Adds the lobe around a half vector's slope, `weight` at its peak.
void addLobe(const SlopeNodes& nodes, const glm::dvec2& slope, double weight, double alpha,
             std::vector<double>& map) {
  const double reach = 4 * alpha;
  const auto first = [&](double s) { return static_cast<int>(nodes.position(s - reach)); };
  const auto last = [&](double s) { return static_cast<int>(nodes.position(s + reach)) + 1; };
  for (int y = first(slope.y); y <= last(slope.y); ++y)
    for (int x = first(slope.x); x <= last(slope.x); ++x) {
      const glm::dvec2 d = (glm::dvec2(nodes.at(x), nodes.at(y)) - slope) / alpha;
      map[static_cast<std::size_t>(y * kConeNodes + x)] += weight * std::exp(-glm::dot(d, d));
    }
}

// A direction of the cone, by a spiral that fills it evenly.
glm::dvec3 coneDirection(const Cone& cone, int i) {
  const double z = 1 - (i + 0.5) / kConeDirections * (1 - std::cos(cone.half_angle_rad));
  const double turn = 2 * std::numbers::pi * std::fmod(i * kSpiralStep, 1.0);
  const glm::dvec3 side = glm::normalize(glm::cross(
      std::abs(cone.axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), cone.axis));
  const glm::dvec3 other = glm::cross(cone.axis, side);
  const double sine = std::sqrt(std::max(1 - z * z, 0.0));
  return cone.axis * z + (side * std::cos(turn) + other * std::sin(turn)) * sine;
}

ChanceMap chanceMap(const ConeShare& light, const glm::dvec3& view, double alpha_l,
                    const SlopeNodes& nodes) {
  std::vector<double> mass(kConeNodes * kConeNodes);
  for (int i = 0; i < kConeDirections; ++i) {
    const glm::dvec3 direction = coneDirection(light.cone, i);
    if (direction.z <= 0) continue;
    const glm::dvec3 h = glm::normalize(direction + view);
    // Slopes per solid angle of the light.
    const double density = 1 / (4 * glm::dot(view, h) * h.z * h.z * h.z);
    addLobe(nodes, glm::dvec2(h) / h.z, density, alpha_l, mass);
  }
  const double best = *std::ranges::max_element(mass);
  ChanceMap map;
  map.share = best > 0 ? light.share : 0;
  for (const double m : mass) map.chance.push_back(static_cast<float>(best > 0 ? m / best : 0));
  return map;
}

}  // namespace

std::vector<double> pixelsUnderCones(std::span<const ConeShare> lights, const glm::dvec3& view,
                                     double alpha_g, double alpha_l, int details, int pixels,
                                     std::uint32_t seed) {
  // Slopes of microdetails: what is left of the surface's without their own lobes.
  const double deviation = std::sqrt((alpha_g * alpha_g - alpha_l * alpha_l) / 2);
  const SlopeNodes nodes{kDeviations * deviation};
  std::vector<ChanceMap> maps;
  for (const ConeShare& light : lights)
    if (light.share > 0) maps.push_back(chanceMap(light, view, alpha_l, nodes));

  std::mt19937_64 random(seed);
  std::normal_distribution<double> slope(0, deviation);
  std::uniform_real_distribution<double> chance(0, 1);
  std::vector<double> reflecting(maps.size());  // over all pixels
  std::vector<std::vector<int>> counts(static_cast<std::size_t>(pixels),
                                       std::vector<int>(maps.size()));
  for (std::vector<int>& count : counts)
    for (int i = 0; i < details; ++i) {
      const auto x = static_cast<int>(nodes.position(slope(random)) + 0.5),
                 y = static_cast<int>(nodes.position(slope(random)) + 0.5);
      const double u = chance(random);
      for (std::size_t l = 0; l < maps.size(); ++l)
        count[l] +=
            u < static_cast<double>(maps[l].chance[static_cast<std::size_t>(y * kConeNodes + x)]);
    }
  for (const std::vector<int>& count : counts)
    for (std::size_t l = 0; l < maps.size(); ++l) reflecting[l] += count[l];
  std::vector<double> values;
  for (const std::vector<int>& count : counts) {
    double value = 0;
    for (std::size_t l = 0; l < maps.size(); ++l)
      if (reflecting[l] > 0) value += maps[l].share * count[l] * pixels / reflecting[l];
    values.push_back(value);
  }
  return values;
}

}  // namespace glintmark::reference
