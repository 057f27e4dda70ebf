// The lobe of a pixel over which normals vary, in double precision, by differences from pixel to
// pixel and matrices of the plane: nothing of what the kernels derive in closed form.
//
// [KHPL16] Kaplanyan, Hill, Patney and Lefohn, "Filtering Distributions of Normals for Shading
// Antialiasing", HPG 2016. [TK19] Tokuyoshi and Kaplanyan, "Improved Geometric Specular
// Antialiasing", I3D 2019. [TK21] the same, "Stable Geometric Specular Antialiasing with
// Projected-Space NDF Filtering", JCGT 10(2).
#pragma once
#include <glm/glm.hpp>

#include "host/core/frame_packing.h"
#include "host/reference/microfacet.h"

namespace glintmark::reference {

/// What is filtered over a pixel: the half vector's slope [KHPL16], the normal [TK19], the half
/// vector projected onto the tangent plane [TK21]; and that under the pixel's box, not a Gaussian,
/// as steps of slopes.
enum class CurvatureFilter { kSlopes, kNormals, kProjected, kFootprint };

/// A pixel of a curved surface, world axes.
struct CurvedPixel {
  ShadingFrame frame;                              // at the pixel's centre
  glm::dvec3 normal_dx{0}, normal_dy{0};           // change of the unit normal per pixel
  glm::dvec3 ray{0, 0, -1}, ray_dx{0}, ray_dy{0};  // from the eye, and its changes per pixel
};

/// The squared roughness of the widened lobe, a matrix along tangent and bitangent: alpha^2 and
/// twice the covariance of the filtered vector under a Gaussian of one pixel's area, of trace
/// `kMostWidening` at most. `light`: unit, world axes.
glm::dmat2 widenedRoughness(const CurvedPixel& pixel, const glm::dvec3& light,
                            const glm::dvec2& alpha, CurvatureFilter filter);
inline constexpr double kMostWidening = 0.18;

/// Mean density of slopes around `slope` over a rectangle of the covariance that a box of one pixel
/// has with steps `a` and `b`; and over the parallelogram itself, by a sum of samples_per_side^2.
double rectangleDensity(const glm::dvec2& slope, const glm::dvec2& a, const glm::dvec2& b,
                        const glm::dvec2& alpha);
double parallelogramDensity(const glm::dvec2& slope, const glm::dvec2& a, const glm::dvec2& b,
                            const glm::dvec2& alpha, Ndf ndf, int samples_per_side);

/// The half vector's projected steps per pixel, bounded as the lobe is.
struct HalfSteps {
  glm::dvec2 right, down;
};
HalfSteps projectedSteps(const CurvedPixel& pixel, const glm::dvec3& light);

/// BRDF times cosine of the widened lobe towards the eye, for a Fresnel term of 1; 0 below the
/// horizons.
double curvedLobe(const CurvedPixel& pixel, const glm::dvec3& light, const glm::dvec2& alpha,
                  CurvatureFilter filter, Ndf ndf);

}  // namespace glintmark::reference
