// Pixels of one shape, side by side on the texture: what truth and methods are evaluated over.
#pragma once
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace glintmark {

struct PixelLattice {
  glm::dvec2 centre_uv{0};                // of pixel (0, 0)
  glm::dvec2 step_x{1, 0}, step_y{0, 1};  // from a pixel to the next [uv]
  glm::dvec2 edge_x{1, 0}, edge_y{0, 1};  // of each pixel's parallelogram [uv]
  int columns = 1, rows = 1;

  std::size_t size() const;
  /// Of the parallelogram [uv squared].
  double area() const;
  /// All of it moved by so many pixels.
  PixelLattice moved(double x_px, double y_px) const;
  /// Its pixels made so many times as long and wide, each about its own centre.
  PixelLattice zoomed(double ratio) const;
};

/// Pixels that lie edge to edge: steps are edges. `area_uv` of each, `aspect` >= 1 its long over
/// its short side, turned by `angle_rad`.
PixelLattice tiledLattice(const glm::dvec2& centre_uv, double area_uv, double aspect,
                          double angle_rad, int columns, int rows);

/// The same pixels, seen through parallelograms of their shape and of at least `least_area_uv`:
/// that of a microdetail, so that a pixel which is smaller sees one on average, as its neighbours
/// do.
PixelLattice grown(const PixelLattice& lattice, double least_area_uv);

/// The planes of kernels/microdetail/microdetail.h, row after row, each of `stride` words; the last
/// pixel fills what is left.
std::vector<std::uint32_t> pixelWords(const PixelLattice& lattice, std::size_t stride);
/// Pixels rounded up so that no lane count reads past the end of a plane.
std::size_t pixelStride(const PixelLattice& lattice);

}  // namespace glintmark
