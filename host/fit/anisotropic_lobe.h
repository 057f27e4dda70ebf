// A linearly transformed cosine without symmetry, and its fit to an anisotropic BRDF.
//
// [KTHDN22] Aakash KT, Heitz, Dupuy, Narayanan, "Bringing Linearly Transformed Cosines to
// Anisotropic GGX", I3D 2022.
#pragma once
#include <glm/glm.hpp>
#include <span>

#include "host/fit/anisotropic_samples.h"

namespace glintmark {

/// Integral over the hemisphere of |lobe / its mass there - brdf / albedo|, in [0, 2], of the lobe
/// of `inverse` = M^-1.
double anisotropicError(const AnisotropicSamples& samples, const glm::dmat3& inverse);

/// M^-1 of the lobe that lies closest to the BRDF in that sense, and in its shares on either side
/// of planes, which still tell lobes apart where the BRDF is a thin arc: the better one of the
/// minima found from the first of `starts` (each an M^-1; not empty), whose samples are used, and
/// from the best of the others.
glm::dmat3 fitAnisotropicLobe(const AnisotropicView& view, std::span<const glm::dmat3> starts);

}  // namespace glintmark
