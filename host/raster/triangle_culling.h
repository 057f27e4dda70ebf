// The SIMD part of binning: which pixels may a triangle cover?
#pragma once
#include <cstdint>

#include "host/raster/binning.h"

namespace glintmark {

inline constexpr std::size_t kCullBatch = 64;

enum class CullResult : std::uint32_t { kInvisible, kVisible, kClip };

/// Pixel rectangles (inclusive, inside the image) of up to kCullBatch triangles.
struct CullBatch {
  std::uint32_t result[kCullBatch];  // CullResult
  std::int32_t x0[kCullBatch], y0[kCullBatch], x1[kCullBatch], y1[kCullBatch];
};

/// Triangles [first, first + count), count <= kCullBatch. Culls those without area, without a pixel
/// centre in their bounding rectangle and, if asked, those that show their back.
void cullTriangles(const ProjectedMesh& mesh, std::size_t first, std::size_t count,
                   CullBatch& batch);

}  // namespace glintmark
