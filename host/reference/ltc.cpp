#include "host/reference/ltc.h"

#include <cmath>
#include <numbers>

namespace glintmark::reference {

double ltcDensity(const glm::dmat3& inverse, const glm::dvec3& direction) {
  const glm::dvec3 t = inverse * direction;
  if (t.z <= 0) return 0;
  // Cosine t.z / |t| over pi times the Jacobian |M^-1| / |t|^3, with |direction| carried along.
  const double length_sq = glm::dot(t, t), direction_sq = glm::dot(direction, direction);
  return t.z / std::numbers::pi * std::abs(glm::determinant(inverse)) * direction_sq *
         std::sqrt(direction_sq) / (length_sq * length_sq);
}

double ltcMassAboveHorizon(const glm::dmat3& inverse) {
  // In the space of the cosine lobe the horizon is the plane with normal M^T z, row z of M. The
  // lobe's mass on one side of it is the area of a half disc and a half ellipse: a lune's form
  // factor.
  const glm::dmat3 forward = glm::inverse(inverse);
  const glm::dvec3 row(forward[0][2], forward[1][2], forward[2][2]);
  return 0.5 * (1 + row.z / glm::length(row));
}

}  // namespace glintmark::reference
