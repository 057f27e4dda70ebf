// Reflecting microdetails that method distributed places one by one: kernels/README.md, "The
// draws".
#pragma once
#include <cstdint>

#include "host/reference/pixel.h"

namespace glintmark::reference {

/// What one pixel sees of them under one light.
struct LitDetails {
  double of_grids = 1;          // share of the pixel's microdetails that its grids have instead
  double sum = 0;               // those that reflect in the footprint, each as large as it is
  double heaviest_rounded = 0;  // of one whose cell's number rounds a real number
  std::uint32_t cells = 0;      // visited
  bool tied = false;            // something lies on the border of what counts
};

/// `microdetails` in the footprint, each reflecting with `probability`; `stretch` of the grids.
LitDetails litDetails(const PixelFootprint& footprint, const glm::dvec2& stretch,
                      const Glints& glints, double microdetails, double probability,
                      HalfVectorIndex half, bool deep_uv);

}  // namespace glintmark::reference
