#include "host/frame/effect/light_tree.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "host/core/float4.h"
#include "host/frame/effect/lights.h"

namespace glintmark {
namespace {

constexpr double kRadianceLevel_log2 = 2;

// A light of the scene, and the sums by which several become one.
struct Part {
  ConeLight light;
  LightCone cone;
  glm::dvec3 flux{0};     // radiance times solid angle
  glm::dvec3 towards{0};  // luminance of the flux times the mean direction
};

double luminanceOf(const glm::dvec3& rgb) {
  return glm::dot(rgb, {0.2126, 0.7152, 0.0722});
}

double chordOf(const LightCone& cone) {
  return std::sqrt(2 * cone.one_minus_cos);
}

Part partOf(const ConeLight& light) {
  Part part{light, coneOf(light)};
  const glm::dvec3 irradiance(light.irradiance.x, light.irradiance.y, light.irradiance.z);
  part.flux = irradiance * (2 / (2 - part.cone.one_minus_cos));
  part.towards = luminanceOf(part.flux) * (1 - 0.5 * part.cone.one_minus_cos) * part.cone.axis;
  return part;
}

ConeLight merged(std::span<const Part> parts) {
  glm::dvec3 flux{0}, towards{0};
  for (const Part& part : parts) {
    flux += part.flux;
    towards += part.towards;
  }
  const double length = glm::length(towards), luminous = luminanceOf(flux);
  const double mean_length = luminous > 0 ? std::min(length / luminous, 1.0) : 0.5;
  const double cosine = std::clamp(2 * mean_length - 1, 0.0, 1.0);
  const glm::dvec3 axis = length > 0 ? towards / length : parts.front().cone.axis;
  ConeLight light{};
  light.direction = toFloat4(axis, std::acos(cosine));
  light.irradiance = toFloat4(flux * (0.5 * (1 + cosine)));
  return light;
}

void addTree(std::span<Part> parts, LightTree& tree) {
  const std::size_t entry = tree.lights.size();
  const bool is_one = parts.size() == 1;
  tree.lights.push_back(is_one ? parts.front().light : merged(parts));
  tree.skips.push_back(1);
  const glm::dvec3 axis = coneOf(tree.lights.back()).axis;
  double reach = 0;
  for (const Part& part : parts)
    reach = std::max(reach, glm::length(part.cone.axis - axis) + chordOf(part.cone));
  tree.reaches.push_back(static_cast<float>(std::min(reach, 2.0)));
  if (is_one) return;
  // Halved along the axis of space along which directions spread most.
  glm::dvec3 sum{0}, squares{0};
  for (const Part& part : parts) {
    sum += part.cone.axis;
    squares += part.cone.axis * part.cone.axis;
  }
  const auto n = static_cast<double>(parts.size());
  const glm::dvec3 spread = squares / n - (sum / n) * (sum / n);
  const int along = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
  std::ranges::stable_sort(parts, {}, [&](const Part& part) { return part.cone.axis[along]; });
  const std::size_t half = parts.size() / 2;
  addTree(parts.first(half), tree);
  addTree(parts.subspan(half), tree);
  tree.skips[entry] = static_cast<unsigned>(tree.lights.size() - entry);
}

}  // namespace

LightTree lightTree(std::span<const ConeLight> lights) {
  LightTree tree;
  std::map<int, std::vector<Part>> levels;
  for (const ConeLight& light : lights) {
    Part part = partOf(light);
    const double angle = part.cone.one_minus_cos, flux = luminanceOf(part.flux);
    if (angle > 0 && flux > 0) {
      const double level = std::floor(std::log2(flux / angle) / kRadianceLevel_log2);
      levels[static_cast<int>(level)].push_back(part);
    } else {
      addTree(std::span(&part, 1), tree);
    }
  }
  for (auto& [level, parts] : levels) addTree(parts, tree);
  return tree;
}

}  // namespace glintmark
