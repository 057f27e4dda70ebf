// Linearly transformed cosines in double precision. [HDHN16] Heitz, Dupuy, Hill, Neubelt,
// "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", SIGGRAPH 2016.
#pragma once
#include <glm/glm.hpp>

namespace glintmark::reference {

/// Density per solid angle of the cosine lobe transformed by M, at a direction (not necessarily
/// unit); integrates to 1 over the sphere, whatever the scale of M^-1. [HDHN16] Eq. 1
double ltcDensity(const glm::dmat3& inverse, const glm::dvec3& direction);

/// Share of that lobe above the plane z = 0, closed form.
double ltcMassAboveHorizon(const glm::dmat3& inverse);

}  // namespace glintmark::reference
