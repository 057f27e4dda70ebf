// Distributions of normals as cosine lobes scaled by alpha across the axis, in double precision:
// [TAO21] Eq. 1 with M = diag(alpha, alpha, 1). Divided by the cosine that is GGX's NDF.
// [TAO21] Tao et al., "Real-Time Antialiased Area Lighting Using Multi-Scale Linearly Transformed
// Cosines", EG 2021 short papers.
#pragma once

namespace glintmark::reference {

/// Density per solid angle at an angle of given cosine to the axis; 0 below the horizon, integrates
/// to 1. alpha > 0.
double scaledCosineDensity(double alpha, double cosine);

/// Length of the mean direction, [TAO21] Eq. 4 in closed form: 1 at alpha = 0, 2/3 at 1, falling.
/// alpha >= 0.
double meanResultantLength(double alpha);

/// Its inverse for alpha in [0, 1], by bisection: 0 for lengths at or above 1, 1 at or below 2/3.
double alphaOfMeanLength(double length);

/// [TAO21] Eq. 5, with the length clamped to [2/3, 1] and the result to [0, 1].
double tao21MesoAlpha(double length);

/// [TAO21] Eq. 7, clamped to [0, 1].
double tao21OverallAlpha(double alpha_mi, double alpha_me);

}  // namespace glintmark::reference
