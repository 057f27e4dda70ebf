#include "host/microdetail/pixel_lattice.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/microdetail/microdetail_types.h"

namespace glintmark {
namespace {

std::uint32_t floatBits(double value) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

}  // namespace

std::size_t PixelLattice::size() const {
  return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
}

double PixelLattice::area() const {
  return std::abs(edge_x.x * edge_y.y - edge_x.y * edge_y.x);
}

PixelLattice PixelLattice::moved(double x_px, double y_px) const {
  PixelLattice lattice = *this;
  lattice.centre_uv += x_px * step_x + y_px * step_y;
  return lattice;
}

PixelLattice PixelLattice::zoomed(double ratio) const {
  PixelLattice lattice = *this;
  lattice.edge_x *= ratio;
  lattice.edge_y *= ratio;
  return lattice;
}

PixelLattice tiledLattice(const glm::dvec2& centre_uv, double area_uv, double aspect,
                          double angle_rad, int columns, int rows) {
  const glm::dvec2 along(std::cos(angle_rad), std::sin(angle_rad));
  const glm::dvec2 across(-along.y, along.x);
  PixelLattice lattice;
  lattice.centre_uv = centre_uv;
  lattice.step_x = lattice.edge_x = along * std::sqrt(area_uv * aspect);
  lattice.step_y = lattice.edge_y = across * std::sqrt(area_uv / aspect);
  lattice.columns = columns;
  lattice.rows = rows;
  return lattice;
}

PixelLattice grown(const PixelLattice& lattice, double least_area_uv) {
  const double scale = std::sqrt(std::max(least_area_uv / lattice.area(), 1.0));
  PixelLattice large = lattice;
  large.edge_x *= scale;
  large.edge_y *= scale;
  return large;
}

std::size_t pixelStride(const PixelLattice& lattice) {
  return (lattice.size() + GM_LIST_PADDING - 1) / GM_LIST_PADDING * GM_LIST_PADDING;
}

std::vector<std::uint32_t> pixelWords(const PixelLattice& lattice, std::size_t stride) {
  std::vector<std::uint32_t> words(MD_PIXEL_PLANES * stride);
  const auto store = [&](std::size_t plane, std::size_t i, std::uint32_t word) {
    words[plane * stride + i] = word;
  };
  for (std::size_t i = 0; i < stride; ++i) {
    const std::size_t pixel = std::min(i, lattice.size() - 1);
    const std::size_t column = pixel % static_cast<std::size_t>(lattice.columns);
    const std::size_t row = pixel / static_cast<std::size_t>(lattice.columns);
    const glm::dvec2 uv = lattice.centre_uv + static_cast<double>(column) * lattice.step_x +
                          static_cast<double>(row) * lattice.step_y;
    const glm::dvec2 whole = glm::floor(uv);
    const auto integer = [](double x) {
      return static_cast<std::uint32_t>(static_cast<std::int32_t>(x));
    };
    const auto fraction = [](double x) { return static_cast<std::uint32_t>(x * 0x1p32); };
    store(MD_U_WHOLE, i, integer(whole.x));
    store(MD_U_FRACTION, i, fraction(uv.x - whole.x));
    store(MD_V_WHOLE, i, integer(whole.y));
    store(MD_V_FRACTION, i, fraction(uv.y - whole.y));
    store(MD_DUDX, i, floatBits(lattice.edge_x.x));
    store(MD_DVDX, i, floatBits(lattice.edge_x.y));
    store(MD_DUDY, i, floatBits(lattice.edge_y.x));
    store(MD_DVDY, i, floatBits(lattice.edge_y.y));
  }
  return words;
}

}  // namespace glintmark
