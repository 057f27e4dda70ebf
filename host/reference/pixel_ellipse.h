// The ellipse that a pixel's footprint is to methods which know no parallelogram.
#pragma once
#include <glm/glm.hpp>

#include "host/reference/footprint.h"

namespace glintmark::reference {

/// The unit circle of pixels, on the texture.
struct PixelEllipse {
  double longer = 0, shorter = 0;  // half axes [uv]
  double angle = 0;                // of the longer one from u, [0, pi)
};
PixelEllipse pixelEllipse(const PixelFootprint& footprint);

/// A cell of a lattice and the position within it, [0, 1) each.
struct LatticeCell {
  std::int32_t x = 0, y = 0;  // modulo 2^32
  glm::dvec2 within{};
};
/// A matrix of whole numbers, in 2^-14.
struct LatticeMatrix {
  int xu = 0, xv = 0, yu = 0, yv = 0;
};
/// (u, v) in units of 2^level, times the matrix. Exact.
LatticeCell latticeCell(const PixelFootprint& footprint, int level, const LatticeMatrix& matrix);

}  // namespace glintmark::reference
