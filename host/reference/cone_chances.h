// Microdetails of one pixel under many cones of light, one by one.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "host/reference/light_cone.h"

namespace glintmark::reference {

/// A light and what the smooth lobe reflects of it, over what it reflects of all.
struct ConeShare {
  Cone cone;
  double share = 0;
};

/// Pixels of `details` microdetails each, seen from `view` (unit, tangent frame): radiance over the
/// smooth lobe's. A microdetail has a random slope, and a random number that decides under which
/// lights it reflects: those of which its lobe, integrated over their half vectors, has more of the
/// most that it has anywhere. So one that is wide beside two cones reflects both or neither, and
/// cones that lie apart share none.
std::vector<double> pixelsUnderCones(std::span<const ConeShare> lights, const glm::dvec3& view,
                                     double alpha_g, double alpha_l, int details, int pixels,
                                     std::uint32_t seed);

}  // namespace glintmark::reference
