// Linear moments of normals, mip-mapped: what the single-lobe methods read. The finest level holds
// the map's texels, between which lookups interpolate; coarser ones are means over the surface that
// this makes, by samples between the texels too (interpolated_normals.h).
#pragma once
#include <cstdint>

#include "host/filter/mip_texels.h"
#include "host/filter/normal_map.h"

namespace glintmark {

/// What the most that making them holds takes [bytes], the moments included, the map not.
/// `vectors`: 1 for mean normals, 2 for LEAN's moments.
std::uint64_t momentBytes(int width_px, int height_px, int vectors, bool between);

/// One float4 a texel: mean normal (x, y, z), not made unit, and 0. Its direction is the plain
/// mip-mapped normal, its length r the evenness of the normals that Toksvig's roughness comes from:
/// variance per axis (1 - r) / r. [Tok04]
/// `between`: whether coarser levels see what lies between texels; without it they are means of the
/// texels alone.
MipTexels meanNormals(const NormalMap& map, bool between = true);

/// Slopes steeper than this are laid here, so that one normal near the horizon does not take over
/// the second moments of every texel above it.
inline constexpr float kMaxLeanSlope = 20.0f;

/// Two float4 a texel: means of slopes (sx, sy, sx^2, sy^2) and (sx sy, 0, 0, 0), where
/// (sx, sy) = (nx, ny) / nz points as the normal leans. Covariance: mean of products less product
/// of means. [OB10]
MipTexels leanMoments(const NormalMap& map);

}  // namespace glintmark
