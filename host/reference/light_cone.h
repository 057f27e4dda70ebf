// Brute force over the directions of a cone light.
#pragma once
#include <glm/glm.hpp>

namespace glintmark::reference {

/// A light at infinity that fills a cone evenly.
struct Cone {
  glm::dvec3 axis{0, 0, 1};  // unit, tangent frame
  double half_angle_rad = 0;
};

/// Mean over the cone of Eq. 1 times i . n, times radiance times solid angle, for an irradiance of
/// 1 on a surface facing the axis: the radiance of the smooth lobe under that light. `samples`
/// directions of a rank-1 lattice, each of equal solid angle; directions below the horizon add 0.
glm::dvec3 coneRadiance(const Cone& light, const glm::dvec3& o, const glm::dvec2& alpha,
                        const glm::dvec3& f0, int samples);

/// The same for a Lambertian surface of albedo 1.
double coneDiffuse(const Cone& light, int samples);

}  // namespace glintmark::reference
