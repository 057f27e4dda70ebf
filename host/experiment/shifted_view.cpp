#include "host/experiment/shifted_view.h"

#include <cmath>
#include <glm/glm.hpp>

#include "host/core/angles.h"

namespace glintmark {

View shiftedView(const View& view, double right_px, double up_px, int height_px) {
  const glm::dvec3 forward = view.target - view.eye;
  const glm::dvec3 right = glm::normalize(glm::cross(forward, view.up));
  const glm::dvec3 up = glm::normalize(glm::cross(right, forward));
  const double pixel =
      2 * glm::length(forward) * std::tan(0.5 * kDegree * view.fov_y_deg) / height_px;
  View moved = view;
  for (glm::dvec3* place : {&moved.eye, &moved.target})
    *place += pixel * (right_px * right + up_px * up);
  return moved;
}

}  // namespace glintmark
