#include "host/reference/pixel_ellipse.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glintmark::reference {
namespace {

constexpr int kMatrixBits = 14;

__extension__ using Wide = __int128;

Wide fixed(FixedCoordinate c) {
  return (static_cast<Wide>(c.integer) << 32) + c.fraction;
}

// sum / 2^shift: whole part modulo 2^32, and the rest.
std::int32_t split(Wide sum, int shift, double& rest) {
  const Wide whole = sum >> shift;
  rest = std::ldexp(static_cast<double>(sum - (whole << shift)), -shift);
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(whole));
}

}  // namespace

PixelEllipse pixelEllipse(const PixelFootprint& footprint) {
  const glm::dvec2 x = footprint.duv_dx, y = footprint.duv_dy;
  // The ends of the half axes: x cos s + y sin s where its length is greatest.
  const double s = 0.5 * std::atan2(2 * glm::dot(x, y), glm::dot(x, x) - glm::dot(y, y));
  const glm::dvec2 major = x * std::cos(s) + y * std::sin(s);
  PixelEllipse e;
  e.longer = std::max(glm::length(major), 0x1p-28);
  e.shorter = std::max(footprintArea(footprint) / e.longer, e.longer * 0x1p-12);
  e.angle = std::atan2(major.y, major.x);
  if (e.angle < 0) e.angle += std::numbers::pi;
  if (e.angle >= std::numbers::pi) e.angle -= std::numbers::pi;
  return e;
}

LatticeCell latticeCell(const PixelFootprint& footprint, int level, const LatticeMatrix& matrix) {
  const Wide u = fixed(footprint.u), v = fixed(footprint.v);
  const int shift = 32 + kMatrixBits + level;
  LatticeCell cell;
  cell.x = split(u * matrix.xu + v * matrix.xv, shift, cell.within.x);
  cell.y = split(u * matrix.yu + v * matrix.yv, shift, cell.within.y);
  return cell;
}

}  // namespace glintmark::reference
