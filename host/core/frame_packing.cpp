#include "host/core/frame_packing.h"

#include <cmath>

namespace glintmark {
namespace {

std::uint32_t quantize(double value) {
  return static_cast<std::uint32_t>(std::lround(value * kFrameScale) + kFrameScale);
}

double dequantize(std::uint32_t q) {
  return static_cast<double>(static_cast<std::int32_t>(q) - kFrameScale) / kFrameScale;
}

double signNotZero(double x) {
  return x < 0 ? -1.0 : 1.0;
}

glm::dvec3 octahedralDecode(std::uint32_t qx, std::uint32_t qy) {
  const double ox = dequantize(qx), oy = dequantize(qy);
  glm::dvec3 n(ox, oy, 1.0 - std::abs(ox) - std::abs(oy));
  if (n.z < 0) {
    n.x = (1.0 - std::abs(oy)) * signNotZero(ox);
    n.y = (1.0 - std::abs(ox)) * signNotZero(oy);
  }
  return glm::normalize(n);
}

// Duff et al. 2017, Listing 3.
void orthonormalBasis(const glm::dvec3& n, glm::dvec3& b1, glm::dvec3& b2) {
  const double sign = signNotZero(n.z);
  const double a = -1.0 / (sign + n.z);
  const double b = n.x * n.y * a;
  b1 = {1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  b2 = {b, sign + n.y * n.y * a, -n.y};
}

}  // namespace

PackedFrame packFrame(const glm::dvec3& normal, const glm::dvec3& tangent, bool mirrored) {
  const glm::dvec3 n = normal / (std::abs(normal.x) + std::abs(normal.y) + std::abs(normal.z));
  double ox = n.x, oy = n.y;
  if (n.z < 0) {
    ox = (1.0 - std::abs(n.y)) * signNotZero(n.x);
    oy = (1.0 - std::abs(n.x)) * signNotZero(n.y);
  }
  const std::uint32_t qx = quantize(ox), qy = quantize(oy);

  glm::dvec3 b1, b2;
  orthonormalBasis(octahedralDecode(qx, qy), b1, b2);
  const double c = glm::dot(tangent, b1), s = glm::dot(tangent, b2);
  const double length = std::abs(c) + std::abs(s);
  const double p = length > 0 ? c / length : 1.0;
  const std::uint32_t qa = quantize(0.5 * std::copysign(1.0 - p, s));

  return {qx | (qa & 0x7FFu) << 21, qy | (qa >> 11) << 21 | (mirrored ? 1u << 31 : 0u)};
}

ShadingFrame unpackFrame(PackedFrame packed) {
  constexpr std::uint32_t kMask = (1u << 21) - 1u;
  ShadingFrame frame;
  frame.normal = octahedralDecode(packed.frame0 & kMask, packed.frame1 & kMask);

  const double d = dequantize(packed.frame0 >> 21 | ((packed.frame1 >> 21) & 0x3FFu) << 11);
  const double p = 1.0 - 2.0 * std::abs(d);
  const glm::dvec2 angle = glm::normalize(glm::dvec2(p, std::copysign(1.0 - std::abs(p), d)));
  glm::dvec3 b1, b2;
  orthonormalBasis(frame.normal, b1, b2);
  frame.tangent = angle.x * b1 + angle.y * b2;
  frame.bitangent = glm::cross(frame.normal, frame.tangent);
  if (packed.frame1 >> 31) frame.bitangent = -frame.bitangent;
  return frame;
}

}  // namespace glintmark
