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
/// directions of the cone and as many half vectors of the lobe, of which those count that mirror
/// the view into the cone, weighted by the balance heuristic (E. Veach 1997, Sect. 9.2), so that
/// neither a narrow lobe nor a narrow cone is missed. Directions below the horizon add 0.
glm::dvec3 coneRadiance(const Cone& light, const glm::dvec3& o, const glm::dvec2& alpha,
                        const glm::dvec3& f0, int samples);

/// The same for a Lambertian surface of albedo 1.
double coneDiffuse(const Cone& light, int samples);

/// [ZK16] Eq. 7 for a cone: the share of the lobe's slopes that mirror some of the light into the
/// eye, over the share of one microdetail's lobe that does, where it points best: the peak that is
/// climbed to from the mean of those slopes. Grooves point across themselves only; along them the
/// lobe is the global one. At most 1; 0 out of reach.
double coneProbability(const Cone& light, const glm::dvec3& o, const glm::dvec2& alpha_g,
                       const glm::dvec2& alpha_l, bool groove, int samples);

}  // namespace glintmark::reference
