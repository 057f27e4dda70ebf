// The Beckmann microfacet lobe in double precision, straight from the formulas.
//
// Directions are unit vectors in the tangent frame (z: normal); slopes are x = m_xy / m_z.
// [ZK16] Zirr and Kaplanyan 2016. [Heitz14] "Understanding the Masking-Shadowing Function in
// Microfacet-Based BRDFs", JCGT 3(2).
#pragma once
#include <glm/glm.hpp>

namespace glintmark::reference {

/// Roughness of the distribution of microdetails, D_m, per axis. [ZK16] Eq. 4; floored at 1e-6 so
/// that alpha_l = alpha_g stays finite.
glm::dvec2 mesoRoughness(const glm::dvec2& alpha_g, const glm::dvec2& alpha_l);

/// Beckmann density over the plane of slopes; integrates to 1. [ZK16] Sect. 3
double slopeDensity(const glm::dvec2& slope, const glm::dvec2& alpha);

/// The one-dimensional analogue across grooves, normalised by 1 / sqrt(pi). [ZK16] Eq. 6
double grooveDensity(double slope_v, double alpha_v);

/// D(m), with the Jacobian between slopes and directions: slopeDensity / (m . n)^4; 0 below the
/// horizon.
double ndf(const glm::dvec3& m, const glm::dvec2& alpha);

/// Smith's Lambda, exact (error function) form. [Heitz14] Eq. 61, anisotropic by Eq. 80
double smithLambda(const glm::dvec3& w, const glm::dvec2& alpha);

/// Masking and shadowing, height correlated. [Heitz14] Eq. 99
double maskingShadowing(const glm::dvec3& i, const glm::dvec3& o, const glm::dvec2& alpha);

/// Schlick's Fresnel term at the angle between light and microfacet.
glm::dvec3 schlick(const glm::dvec3& f0, double cosine);

/// [ZK16] Eq. 1 times i . n; 0 when i or o is not above the surface.
glm::dvec3 brdfTimesCosine(const glm::dvec3& i, const glm::dvec3& o, const glm::dvec2& alpha,
                           const glm::dvec3& f0);

/// [ZK16] Eq. 7: probability that a microdetail reflects from i to o, at most 1.
double reflectProbability(const glm::dvec3& i, const glm::dvec3& o, const glm::dvec2& alpha_g,
                          const glm::dvec2& alpha_l, bool groove);

}  // namespace glintmark::reference
