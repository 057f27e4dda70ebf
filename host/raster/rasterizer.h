// The host rasterizer: scene and view in, planes and pixel lists out.
#pragma once
#include <cstdint>
#include <memory>

#include "host/core/planes.h"
#include "host/raster/camera.h"
#include "host/scene/scene.h"

namespace glintmark {

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFu;

/// What one call of Rasterizer::render did and how long it took (wall time).
struct RasterStats {
  double setup_ns = 0;       // transform, clip, set up, bin
  double visibility_ns = 0;  // depth test; 0 if fused with resolve
  double resolve_ns = 0;     // attributes into planes
  std::size_t triangles_in = 0;
  std::size_t triangles_drawn = 0;  // after clipping and culling, before the depth test
};

/// Draws triangle meshes into a visibility buffer and resolves it into planes. Keeps its buffers
/// from call to call; not safe to call from two threads at once.
class Rasterizer {
 public:
  explicit Rasterizer(int thread_count = 0);  // 0: all cores
  ~Rasterizer();
  Rasterizer(Rasterizer&&) noexcept;
  Rasterizer& operator=(Rasterizer&&) noexcept;

  /// Visibility and resolve. Writes only the planes of `mask` (Plane::kPixel is always added).
  RasterStats render(const TriangleMesh& mesh, const Camera& camera, bool cull_back_faces,
                     PlaneMask mask, PixelPlanes& out);

  /// Visibility only: for every pixel, row by row, the index of the nearest triangle or
  /// kNoTriangle. `triangle_ids` gets width * height entries.
  RasterStats renderVisibility(const TriangleMesh& mesh, const Camera& camera, bool cull_back_faces,
                               std::vector<std::uint32_t>& triangle_ids);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace glintmark
