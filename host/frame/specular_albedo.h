// What a material's specular lobe reflects on the whole, for programs that give its diffuse layer
// the rest (kernels/scatter/albedo_scaling.clh).
#pragma once
#include "host/core/shared_types.h"
#include "host/reference/microfacet.h"

namespace glintmark {

/// Directional albedo of a lobe for one cosine to the view: at a Fresnel term of 1, and with
/// Schlick's (1 - o.h)^5 in its place.
struct SplitAlbedo {
  double mirror = 0, schlick = 0;
};
/// `mu` in [0, 1], `alpha` in (0, 1]; good to 2e-3 for alpha >= 0.01.
SplitAlbedo specularAlbedo(reference::Ndf ndf, double mu, double alpha);

/// Sets the polynomials of the albedo in `surface`. A roughness that differs along u and v counts
/// as the square root of their product.
void setSpecularAlbedo(SurfaceMaterial& surface, bool ggx);

}  // namespace glintmark
