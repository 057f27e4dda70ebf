// Deterministic cubature over the hemisphere, concentrated where a BRDF and a lobe fitted to it
// have their mass.
#pragma once
#include <vector>

#include "host/fit/ltc_lobe.h"

namespace glintmark {

/// Sample directions i of one half of the hemisphere (y >= 0; the BRDF is symmetric), with weights
/// such that sum weight g(i) approximates the integral of g over the whole hemisphere; of
/// Ndf::kNormals, over the sphere.
struct LtcSamples {
  std::vector<double> x, y_sq, z;
  std::vector<double> weight;
  std::vector<double> brdf;  // BRDF times cosine at F0 = 1
  double albedo = 0;         // integrals of brdf, and of brdf times (1 - o.h)^5
  double schlick_albedo = 0;
  bool whole_sphere = false;  // of Ndf::kNormals: samples, and the lobe, are not cut at the horizon
};

struct LtcSampleCounts {
  int lobe_radial = 64, lobe_azimuth = 24;
  int hemisphere_radial = 24, hemisphere_azimuth = 16;
};

/// Samples for the view (sin theta, 0, cos theta), cos_theta in [0, 1], roughness alpha > 0: a
/// regular grid in the unit square of a cosine lobe transformed by `proposal`, widened, and one of
/// the uniform hemisphere, weighted by the balance heuristic [Veach97] Eq. 9.8. So the integrand
/// may lie anywhere and be as narrow as the lobe.
LtcSamples makeLtcSamples(reference::Ndf ndf, double alpha, double cos_theta,
                          const LtcLobe& proposal, const LtcSampleCounts& counts = {});

}  // namespace glintmark
