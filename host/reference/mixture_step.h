// One step of expectation maximisation of a mixture of normals, in double precision: [TAN05]
// Sect. 4.1, as printed there.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "host/reference/normal_lobe.h"

namespace glintmark::reference {

/// A normal projected onto the tangent plane, and how much of it lies under the texel.
struct CoveredNormal {
  glm::dvec2 xy{0, 0};
  double share = 1;  // [0, 1]
};

/// The mixture that one E-step and one M-step make of `lobes` (variances above 0). `normals`: those
/// under the texel, of any total share above 0. `neighbours`: mixtures of as many lobes, whose
/// means pull with the paper's constant `c` >= 0. A lobe that neither a normal nor a neighbour
/// weighs anything for keeps mean and variance.
std::vector<NormalLobe> mixtureStep(std::span<const NormalLobe> lobes,
                                    std::span<const CoveredNormal> normals,
                                    std::span<const std::vector<NormalLobe>> neighbours, double c);

}  // namespace glintmark::reference
