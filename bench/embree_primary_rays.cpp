#include "bench/embree_primary_rays.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace glintmark::bench {
namespace {

constexpr int kTile_px = 32;

struct Tile {
  int x0, y0, x1, y1;
};

// Rays of one camera, in single precision as Embree takes them.
struct RayGrid {
  explicit RayGrid(const Camera& c)
      : width(c.width_px),
        origin(c.eye),
        first(c.ray_origin),
        dx(c.ray_dx),
        dy(c.ray_dy),
        near_plane(static_cast<float>(c.near_plane)) {}
  glm::vec3 direction(int x, int y) const {
    return first + static_cast<float>(x) * dx + static_cast<float>(y) * dy;
  }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  int width;
  glm::vec3 origin, first, dx, dy;
  float near_plane;
};

RTCIntersectContext coherentContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

void setRay(const RayGrid& grid, int x, int y, RTCRayHit& hit) {
  const glm::vec3 d = grid.direction(x, y);
  hit.ray = {grid.origin.x,
             grid.origin.y,
             grid.origin.z,
             grid.near_plane,
             d.x,
             d.y,
             d.z,
             0,
             INFINITY,
             ~0u,
             0,
             0};
  hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  hit.hit.primID = RTC_INVALID_GEOMETRY_ID;
}

void traceSingle(RTCScene scene, const RayGrid& grid, const Tile& tile, std::uint32_t* ids) {
  RTCIntersectContext context = coherentContext();
  RTCRayHit hit;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      setRay(grid, x, y, hit);
      rtcIntersect1(scene, &context, &hit);
      ids[grid.index(x, y)] = hit.hit.primID;
    }
}

void traceStream(RTCScene scene, const RayGrid& grid, const Tile& tile, std::uint32_t* ids) {
  RTCIntersectContext context = coherentContext();
  RTCRayHit hits[kTile_px * kTile_px];
  unsigned count = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) setRay(grid, x, y, hits[count++]);
  rtcIntersect1M(scene, &context, hits, count, sizeof(RTCRayHit));
  count = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) ids[grid.index(x, y)] = hits[count++].hit.primID;
}

// Packets of 4 x 4 pixels.
void tracePackets(RTCScene scene, const RayGrid& grid, const Tile& tile, std::uint32_t* ids) {
  RTCIntersectContext context = coherentContext();
  alignas(64) RTCRayHit16 hit;
  alignas(64) int valid[16];
  for (int y = tile.y0; y < tile.y1; y += 4)
    for (int x = tile.x0; x < tile.x1; x += 4) {
      for (int i = 0; i < 16; ++i) {
        const int px = x + i % 4, py = y + i / 4;
        valid[i] = px < tile.x1 && py < tile.y1 ? -1 : 0;
        const glm::vec3 d = grid.direction(px, py);
        hit.ray.org_x[i] = grid.origin.x;
        hit.ray.org_y[i] = grid.origin.y;
        hit.ray.org_z[i] = grid.origin.z;
        hit.ray.tnear[i] = grid.near_plane;
        hit.ray.dir_x[i] = d.x;
        hit.ray.dir_y[i] = d.y;
        hit.ray.dir_z[i] = d.z;
        hit.ray.time[i] = 0;
        hit.ray.tfar[i] = INFINITY;
        hit.ray.mask[i] = ~0u;
        hit.ray.id[i] = 0;
        hit.ray.flags[i] = 0;
        hit.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
        hit.hit.primID[i] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect16(valid, scene, &context, &hit);
      for (int i = 0; i < 16; ++i)
        if (valid[i]) ids[grid.index(x + i % 4, y + i / 4)] = hit.hit.primID[i];
    }
}

}  // namespace

void traceEmbree(const test::EmbreeOracle& oracle, const Camera& camera, RayMode mode,
                 std::vector<std::uint32_t>& triangle_ids) {
  const RayGrid grid(camera);
  triangle_ids.resize(grid.index(0, camera.height_px));
  const int tiles_x = (camera.width_px + kTile_px - 1) / kTile_px;
  const int tiles_y = (camera.height_px + kTile_px - 1) / kTile_px;
  tbb::parallel_for(tbb::blocked_range2d<int>(0, tiles_y, 0, tiles_x), [&](const auto& range) {
    for (int ty = range.rows().begin(); ty < range.rows().end(); ++ty)
      for (int tx = range.cols().begin(); tx < range.cols().end(); ++tx) {
        const Tile tile{tx * kTile_px, ty * kTile_px,
                        std::min((tx + 1) * kTile_px, camera.width_px),
                        std::min((ty + 1) * kTile_px, camera.height_px)};
        switch (mode) {
          case RayMode::kSingle:
            traceSingle(oracle.scene(), grid, tile, triangle_ids.data());
            break;
          case RayMode::kPacket16:
            tracePackets(oracle.scene(), grid, tile, triangle_ids.data());
            break;
          case RayMode::kStream:
            traceStream(oracle.scene(), grid, tile, triangle_ids.data());
            break;
        }
      }
  });
}

}  // namespace glintmark::bench
