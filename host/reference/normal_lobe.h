// One Gaussian of normals under a light, in double precision: [TAN05] Sect. 3 and appendix.
#pragma once
#include <glm/glm.hpp>

namespace glintmark::reference {

struct NormalLobe {
  double weight = 0;
  glm::dvec2 mean{0, 0};  // of the normals projected onto the tangent plane
  double variance = 0;    // per axis
};

/// The lobe of filtered moments (a, a mean.x, a mean.y, a (2 s^2 + |mean|^2)).
NormalLobe lobeFromMoments(const glm::dvec4& moments);

/// Share of the Gaussian that lies on the unit disk, where projected normals are.
double massOnDisk(const NormalLobe& lobe);

/// Mean of the lobe's unit normals, of which mean and variance are those of their projection: z is
/// the root of its mean square, less what it varies to second order; the square is at least a 64th
/// of that of the mean's own z.
glm::dvec3 meanNormal(const NormalLobe& lobe);

struct LobeLight {
  double specular = 0;  // G D / (4 o.n), Fresnel term left out
  double cosine = 0;    // i.n of the mean normal, at least 0
};

/// The lobe under light and view (unit, tangent space) on a base lobe of Beckmann roughness
/// `alpha`. The convolved lobe is a Gaussian whose covariance is the sum of both in the tangent
/// plane of the mean normal. Its exponent is that of slopes around the mean normal and that of
/// projected normals, weighted by the shares of the variance across the tilt; masking and cosines
/// are taken at the mean of the normals given the half vector. What of the Gaussian lies on the
/// disk reflects all of its light; the cosine is that of meanNormal.
LobeLight shadeLobe(const NormalLobe& lobe, const glm::dvec3& light, const glm::dvec3& view,
                    double alpha);

}  // namespace glintmark::reference
