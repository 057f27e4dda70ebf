// Primary rays of a camera through Embree, in its three fast ways, parallel over 32 x 32 px tiles.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "host/core/planes.h"
#include "tests/raster/embree_oracle.h"

namespace glintmark::bench {

enum class RayMode {
  kSingle,
  kPacket16,
#if GLINTMARK_RAY_STREAMS
  kStream,
#endif
};

/// First triangle per pixel, row by row, kNoTriangle where there is none.
void traceEmbree(const test::EmbreeOracle& oracle, const Camera& camera, RayMode mode,
                 std::vector<std::uint32_t>& triangle_ids);

/// The work of Rasterizer::render with Embree in the place of its depth test: packets of 16 rays,
/// then the rasterizer's own attribute code for the triangles hit. Every tile has a fixed place in
/// the planes, so nothing is counted or laid out, and materials are not told apart.
class EmbreeRenderer {
 public:
  void render(const test::EmbreeOracle& oracle, const TriangleMesh& mesh, const Camera& camera,
              PlaneMask mask, PixelPlanes& out);

 private:
  struct Scratch;
  std::vector<std::uint32_t> ids_;
  std::vector<std::shared_ptr<Scratch>> scratch_;  // per thread
};

}  // namespace glintmark::bench
