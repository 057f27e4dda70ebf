#include "host/scene/view_path.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "host/core/error.h"

namespace glintmark {
namespace {

// `v` turned around a unit axis, anticlockwise as the axis points at the onlooker (Rodrigues).
glm::dvec3 turnedAround(const glm::dvec3& v, const glm::dvec3& axis, double angle_rad) {
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  return v * c + glm::cross(axis, v) * s + axis * (glm::dot(axis, v) * (1 - c));
}

}  // namespace

ViewPath parseViewPath(const std::string& name) {
  if (name == "orbit") return ViewPath::kOrbit;
  if (name == "dolly") return ViewPath::kDolly;
  if (name == "pan") return ViewPath::kPan;
  throw Error(fmt::format("unknown path '{}'; paths are orbit, dolly and pan", name));
}

View viewOnPath(const View& view, ViewPath path, double way) {
  View moved = view;
  moved.orbit.reset();
  const glm::dvec3 axis = glm::normalize(view.up);
  switch (path) {
    case ViewPath::kOrbit:
      moved.eye = view.target + turnedAround(view.eye - view.target, axis, glm::radians(way));
      break;
    case ViewPath::kDolly:
      if (!(way < 100))
        throw Error(fmt::format("a dolly of {} % of the distance reaches the target", way));
      moved.eye = view.eye + way / 100 * (view.target - view.eye);
      break;
    case ViewPath::kPan:
      moved.target = view.eye + turnedAround(view.target - view.eye, axis, -glm::radians(way));
      break;
  }
  return moved;
}

}  // namespace glintmark
