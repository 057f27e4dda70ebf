// Other authors' ways to count glints, for one pixel and light: kernels/README.md, "The draws of
// rivals".
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

#include "host/reference/footprint.h"
#include "host/reference/pixel.h"

namespace glintmark::reference {

/// What a pixel makes of the smooth lobe under a light.
struct RivalRatio {
  double ratio = 0;  // 1 on average, where the method is right
  std::uint32_t visited = 0;
  bool limited = false;
};

/// One light: `probability` by [ZK16] Eq. 7, `half` the half vector (unit, tangent frame).
struct RivalLight {
  double probability = 0;
  glm::dvec3 half{0, 0, 1};
};

/// [DB23]; `as_published` with what the authors' code adds to the paper.
RivalRatio deliotBelcour(const PixelFootprint& footprint, const Glints& glints,
                         const RivalLight& light, bool as_published);

/// [KPT25], for Beckmann's lobe.
RivalRatio kemppinen(const PixelFootprint& footprint, const Glints& glints,
                     const RivalLight& light);

/// [CSDD20]; `as_published` with what the authors' code adds, and without what it leaves out.
RivalRatio chermain(const PixelFootprint& footprint, const Glints& glints, const RivalLight& light,
                    bool as_published);
/// A distribution of its dictionary: the density of slopes over alpha along one axis.
double chermainMarginal(int level, std::uint32_t which, bool as_published, double slope);

/// The shader that [ZK16]'s authors published, with its defects but for its fireflies: sums of
/// floats make those, and these are doubles.
/// Its hash of a number, [0, 1).
double publishedHash(float n);
RivalRatio publishedZk16(const PixelFootprint& footprint, const Glints& glints,
                         const RivalLight& light);

}  // namespace glintmark::reference
