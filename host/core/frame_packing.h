// The shading frame of a pixel in 8 bytes: octahedral normal, tangent angle, handedness.
//
// Bit layout (also read by kernels/frame.clh):
//   frame0 = qx | (qa & 0x7FF) << 21
//   frame1 = qy | (qa >> 11)   << 21 | (mirrored ? 1 << 31 : 0)
// qx, qy are the octahedral coordinates of the normal and qa the tangent's diamond angle, each in
// [-1, 1] and stored as round(value * kFrameScale) + kFrameScale in 21 bits, so that -1, 0 and 1
// are exact. The tangent angle is measured in the orthonormal basis of the *decoded* normal after
// Duff et al. 2017, "Building an Orthonormal Basis, Revisited". The bitangent is n x t, or its
// opposite where uv charts are mirrored. Angular error is below 4e-6 rad.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

namespace glintmark {

inline constexpr std::int32_t kFrameScale = (1 << 20) - 1;

struct PackedFrame {
  std::uint32_t frame0 = 0;
  std::uint32_t frame1 = 0;
};

struct ShadingFrame {
  glm::dvec3 tangent{1, 0, 0};
  glm::dvec3 bitangent{0, 1, 0};
  glm::dvec3 normal{0, 0, 1};
};

/// Packs a frame. `normal` need not be unit but must not be zero; `tangent` need not be orthogonal
/// to it, and where it is zero or parallel to the normal the packed tangent is the basis' first
/// axis. Scalar reference of the rasterizer's SIMD version.
PackedFrame packFrame(const glm::dvec3& normal, const glm::dvec3& tangent, bool mirrored);

/// Inverse of packFrame: three unit vectors, orthogonal to double precision.
ShadingFrame unpackFrame(PackedFrame packed);

}  // namespace glintmark
