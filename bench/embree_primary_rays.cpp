#include "bench/embree_primary_rays.h"

#include <tbb/blocked_range2d.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "host/raster/attribute_table.h"
#include "host/raster/pixel_attributes.h"
#include "host/raster/tile_pixels.h"

namespace glintmark::bench {
namespace {

constexpr int kTile_px = kTileSize_px;

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
  RTCRayHit hit;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      setRay(grid, x, y, hit);
      test::intersect(scene, hit, test::RayOrder::kCoherent);
      ids[grid.index(x, y)] = hit.hit.primID;
    }
}

#if GLINTMARK_RAY_STREAMS
void traceStream(RTCScene scene, const RayGrid& grid, const Tile& tile, std::uint32_t* ids) {
  RTCRayHit hits[kTile_px * kTile_px];
  unsigned count = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) setRay(grid, x, y, hits[count++]);
  test::intersectStream(scene, hits, count, test::RayOrder::kCoherent);
  count = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) ids[grid.index(x, y)] = hits[count++].hit.primID;
}
#endif

// Packets of 4 x 4 pixels.
void tracePackets(RTCScene scene, const RayGrid& grid, const Tile& tile, std::uint32_t* ids) {
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
      test::intersect16(scene, valid, hit, test::RayOrder::kCoherent);
      for (int i = 0; i < 16; ++i)
        if (valid[i]) ids[grid.index(x + i % 4, y + i / 4)] = hit.hit.primID[i];
    }
}

// Calls body(tile, index) for every tile of the image, in parallel.
template <class Body>
void forEachTile(const Camera& camera, const Body& body) {
  const int tiles_x = (camera.width_px + kTile_px - 1) / kTile_px;
  const int tiles_y = (camera.height_px + kTile_px - 1) / kTile_px;
  tbb::parallel_for(tbb::blocked_range2d<int>(0, tiles_y, 0, tiles_x), [&](const auto& range) {
    for (int ty = range.rows().begin(); ty < range.rows().end(); ++ty)
      for (int tx = range.cols().begin(); tx < range.cols().end(); ++tx)
        body(Tile{tx * kTile_px, ty * kTile_px, std::min((tx + 1) * kTile_px, camera.width_px),
                  std::min((ty + 1) * kTile_px, camera.height_px)},
             static_cast<std::size_t>(ty * tiles_x + tx));
  });
}

// The covered pixels of a tile; `slot_of_triangle` holds kNoTriangle throughout, before and after.
void collectHits(const RayGrid& grid, const Tile& tile, const std::uint32_t* ids,
                 std::uint32_t* slot_of_triangle, TilePixels& out) {
  out.triangle_count = out.pixel_count = 0;
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) {
      const std::uint32_t triangle = ids[grid.index(x, y)];
      if (triangle == kNoTriangle) continue;
      std::uint32_t& slot = slot_of_triangle[triangle];
      if (slot == kNoTriangle) {
        slot = out.triangle_count;
        out.triangles[out.triangle_count++] = triangle;
      }
      out.slots[out.pixel_count] = slot;
      out.pixels[out.pixel_count++] =
          static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x);
    }
  for (std::uint32_t i = 0; i < out.triangle_count; ++i)
    slot_of_triangle[out.triangles[i]] = kNoTriangle;
  if (out.pixel_count == 0) return;
  // What a SIMD batch reads beyond the end.
  std::fill_n(out.triangles + out.triangle_count, kListSlack, out.triangles[0]);
  std::fill_n(out.slots + out.pixel_count, kListSlack, 0u);
  std::fill_n(out.pixels + out.pixel_count, kListSlack, out.pixels[0]);
}

}  // namespace

void traceEmbree(const test::EmbreeOracle& oracle, const Camera& camera, RayMode mode,
                 std::vector<std::uint32_t>& triangle_ids) {
  const RayGrid grid(camera);
  triangle_ids.resize(grid.index(0, camera.height_px));
  forEachTile(camera, [&](const Tile& tile, std::size_t) {
    switch (mode) {
      case RayMode::kSingle:
        traceSingle(oracle.scene(), grid, tile, triangle_ids.data());
        break;
      case RayMode::kPacket16:
        tracePackets(oracle.scene(), grid, tile, triangle_ids.data());
        break;
#if GLINTMARK_RAY_STREAMS
      case RayMode::kStream:
        traceStream(oracle.scene(), grid, tile, triangle_ids.data());
        break;
#endif
    }
  });
}

struct EmbreeRenderer::Scratch {
  std::vector<std::uint32_t> slot_of_triangle;
  TilePixels pixels;
  AttributeTable table;
};

void EmbreeRenderer::render(const test::EmbreeOracle& oracle, const TriangleMesh& mesh,
                            const Camera& camera, PlaneMask mask, PixelPlanes& out) {
  const RayGrid grid(camera);
  const int tiles_x = (camera.width_px + kTile_px - 1) / kTile_px;
  const int tiles_y = (camera.height_px + kTile_px - 1) / kTile_px;
  out.mask = mask;
  out.stride = static_cast<std::size_t>(tiles_x * tiles_y) * kTilePixels;
  out.storage.reserve(out.stride * mask.size());
  ids_.resize(grid.index(0, camera.height_px));
  scratch_.resize(static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()));
  forEachTile(camera, [&](const Tile& tile, std::size_t index) {
    auto& own = scratch_[static_cast<std::size_t>(tbb::this_task_arena::current_thread_index())];
    if (!own) own = std::make_shared<Scratch>();
    own->slot_of_triangle.resize(mesh.triangleCount(), kNoTriangle);
    tracePackets(oracle.scene(), grid, tile, ids_.data());
    collectHits(grid, tile, ids_.data(), own->slot_of_triangle.data(), own->pixels);
    if (own->pixels.pixel_count == 0) return;
    setUpAttributes(mesh, camera, own->pixels.triangles, own->pixels.triangle_count, true,
                    own->table);
    writeAttributes(own->table, own->pixels, 0, own->pixels.pixel_count, index * kTilePixels, out);
  });
}

}  // namespace glintmark::bench
