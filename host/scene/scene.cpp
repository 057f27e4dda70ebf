#include "host/scene/scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "host/core/error.h"
#include "host/core/unknown_name.h"

namespace glintmark {

View orbitView(const View& base, const Orbit& orbit) {
  if (!(orbit.angle_deg > 0 && orbit.angle_deg <= 90)) {
    throw Error(fmt::format("an orbit's angle is {} degrees, expected a number in (0, 90]",
                            orbit.angle_deg));
  }
  if (!(orbit.distance > 0 && std::isfinite(orbit.distance))) {
    throw Error(
        fmt::format("an orbit's distance is {}, expected a number above 0", orbit.distance));
  }
  const double normal_length = glm::length(orbit.normal);
  if (!(normal_length > 0 && std::isfinite(normal_length))) {
    throw Error("an orbit's normal has no direction, expected a vector that is not 0");
  }
  const glm::dvec3 normal = orbit.normal / normal_length;
  const glm::dvec3 reference =
      std::abs(normal.z) > 0.9 ? glm::dvec3(0, -1, 0) : glm::dvec3(0, 0, 1);
  const glm::dvec3 forth = glm::normalize(reference - normal * glm::dot(normal, reference));
  const glm::dvec3 side = glm::cross(normal, forth);
  const double azimuth = glm::radians(orbit.azimuth_deg), angle = glm::radians(orbit.angle_deg);
  const glm::dvec3 along = std::cos(azimuth) * forth + std::sin(azimuth) * side;

  View view = base;
  view.orbit = orbit;
  view.target = orbit.target;
  view.eye = orbit.target + orbit.distance * (std::sin(angle) * normal + std::cos(angle) * along);
  view.up = std::cos(angle) * normal - std::sin(angle) * along;
  return view;
}

const View& Scene::view(const std::string& view_name) const {
  std::vector<std::string> known;
  for (const View& candidate : views) {
    if (candidate.name == view_name) return candidate;
    known.push_back(candidate.name);
  }
  throw Error(unknownName("view", view_name, known, "views of scene " + name));
}

}  // namespace glintmark
