#include "host/raster/tile_visibility.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "host/raster/tile_visibility.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glintmark::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::ScalableTag<double>;
using F32 = hn::Rebind<float, F64>;
using I32 = hn::Rebind<std::int32_t, F64>;
using VD = hn::Vec<F64>;
using VI = hn::Vec<I32>;

// A row of pixels is tested in vectors that may start anywhere, so rows have room for one more.
constexpr int kRowStride = kTileSize_px + 16;

// Rows are drawn in groups of this many. The rows a small triangle does not reach cost less than a
// mispredicted end of a loop, and edges alone decide what is covered.
constexpr int kRowGroup = 4;
constexpr int kRows = kTileSize_px + kRowGroup - 1;

struct TileBuffer {
  alignas(64) float depth[kRows * kRowStride];
  alignas(64) std::int32_t nearest[kRows * kRowStride];
};

// Up to one vector of triangles, ready to draw into one tile. Edge i is inside where
// c + a * x + b * y >= 0 for pixel (x, y) of the tile.
struct TriangleBatch {
  static constexpr std::size_t kMax = hn::MaxLanes(F64());
  alignas(64) std::int32_t a[3][kMax], b[3][kMax], c[3][kMax];
  alignas(64) float z[kMax], z_dx[kMax], z_dy[kMax];
  alignas(64) std::int32_t x0[kMax], y0[kMax], x1[kMax], y1[kMax];  // pixels, inclusive
};

struct Corners {
  VI x[3], y[3];
  hn::Vec<F32> z[3];
};

HWY_INLINE Corners gatherUnclipped(const ProjectedMesh& mesh, VI triangles) {
  const I32 di;
  const F32 df;
  const auto* indices = reinterpret_cast<const std::int32_t*>(mesh.mesh->triangles.data());
  const auto* vertices = reinterpret_cast<const std::int32_t*>(mesh.vertices.data());
  const VI at = hn::Add(hn::Add(triangles, triangles), triangles);
  Corners corners;
  for (int i = 0; i < 3; ++i) {
    const VI v = hn::ShiftLeft<2>(hn::GatherIndex(di, indices + i, at));
    corners.x[i] = hn::GatherIndex(di, vertices, v);
    corners.y[i] = hn::GatherIndex(di, vertices + 1, v);
    corners.z[i] = hn::BitCast(df, hn::GatherIndex(di, vertices + 2, v));
  }
  return corners;
}

HWY_INLINE Corners loadClipped(const ProjectedMesh& mesh, const TileBins& bins,
                               const std::uint32_t* entries) {
  constexpr std::size_t kMax = TriangleBatch::kMax;
  const I32 di;
  HWY_ALIGN std::int32_t x[3][kMax], y[3][kMax];
  HWY_ALIGN float z[3][kMax];
  for (std::size_t lane = 0; lane < hn::Lanes(di); ++lane)
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t entry = entries[lane];
      const ScreenVertex& v = entry & kClippedBit ? bins.clipped(entry).vertices[i]
                                                  : mesh.vertices[mesh.mesh->triangles[entry][i]];
      x[i][lane] = v.x;
      y[i][lane] = v.y;
      z[i][lane] = v.inverse_depth;
    }
  Corners corners;
  for (int i = 0; i < 3; ++i) {
    corners.x[i] = hn::Load(di, x[i]);
    corners.y[i] = hn::Load(di, y[i]);
    corners.z[i] = hn::Load(F32(), z[i]);
  }
  return corners;
}

// First and last pixel of the tile whose centre may lie inside, on one axis.
HWY_INLINE void pixelRange(const VI (&p)[3], VI& first, VI& last) {
  const I32 di;
  first = hn::ShiftRight<kSubpixelBits>(
      hn::Add(hn::Min(hn::Min(p[0], p[1]), p[2]), hn::Set(di, kSubpixels - 1)));
  last = hn::ShiftRight<kSubpixelBits>(hn::Max(hn::Max(p[0], p[1]), p[2]));
  first = hn::Max(first, hn::Zero(di));
  last = hn::Min(last, hn::Set(di, kTileSize_px - 1));
}

// The edge from corner `p` with direction (dx, dy), positive on its inner side.
HWY_INLINE void setUpEdge(VD px, VD py, VD dx, VD dy, int edge, TriangleBatch& batch) {
  const F64 d;
  const I32 di;
  const VD zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const VD a = hn::Neg(dy), b = dx;
  // Top-left rule: a pixel centre on the edge belongs to the triangle on the edge's right, or below
  // it where the edge is horizontal. All values are whole numbers.
  const auto owns = hn::Or(hn::Gt(a, zero), hn::And(hn::Eq(a, zero), hn::Gt(b, zero)));
  const VD at_origin =
      hn::Sub(hn::Sub(hn::Mul(dy, px), hn::Mul(dx, py)), hn::IfThenElse(owns, zero, one));
  // kSubpixels * (a x + b y) + at_origin >= 0 is the same as a x + b y + floor(at_origin /
  // kSubpixels) >= 0. Within the tile |a x + b y| < 2^29, so the limit changes no sign.
  const VD c = hn::Floor(hn::Mul(at_origin, hn::Set(d, 1.0 / kSubpixels)));
  const VD limit = hn::Set(d, 1073741824.0);
  hn::Store(hn::DemoteTo(di, a), di, batch.a[edge]);
  hn::Store(hn::DemoteTo(di, b), di, batch.b[edge]);
  hn::Store(hn::DemoteTo(di, hn::Max(hn::Min(c, limit), hn::Neg(limit))), di, batch.c[edge]);
}

HWY_INLINE void setUpTriangles(const Corners& corners, std::int32_t tile_x, std::int32_t tile_y,
                               TriangleBatch& batch) {
  const F64 d;
  const F32 df;
  const I32 di;
  VI xi[3], yi[3];
  VD x[3], y[3], z[3];
  for (int i = 0; i < 3; ++i) {
    xi[i] = hn::Sub(corners.x[i], hn::Set(di, tile_x));
    yi[i] = hn::Sub(corners.y[i], hn::Set(di, tile_y));
    x[i] = hn::PromoteTo(d, xi[i]);
    y[i] = hn::PromoteTo(d, yi[i]);
    z[i] = hn::PromoteTo(d, corners.z[i]);
  }
  VI first, last;
  pixelRange(xi, first, last);
  hn::Store(first, di, batch.x0);
  hn::Store(last, di, batch.x1);
  pixelRange(yi, first, last);
  hn::Store(first, di, batch.y0);
  hn::Store(last, di, batch.y1);

  const VD dx1 = hn::Sub(x[1], x[0]), dy1 = hn::Sub(y[1], y[0]), dz1 = hn::Sub(z[1], z[0]);
  const VD dx2 = hn::Sub(x[2], x[0]), dy2 = hn::Sub(y[2], y[0]), dz2 = hn::Sub(z[2], z[0]);
  const VD area = hn::Sub(hn::Mul(dx1, dy2), hn::Mul(dx2, dy1));
  // Either winding: turn the edges of the other one round.
  const VD sign = hn::CopySignToAbs(hn::Set(d, 1.0), area);
  const VD dx0 = hn::Sub(x[2], x[1]), dy0 = hn::Sub(y[2], y[1]);
  setUpEdge(x[0], y[0], hn::Mul(sign, dx1), hn::Mul(sign, dy1), 0, batch);
  setUpEdge(x[1], y[1], hn::Mul(sign, dx0), hn::Mul(sign, dy0), 1, batch);
  setUpEdge(x[0], y[0], hn::Mul(sign, hn::Neg(dx2)), hn::Mul(sign, hn::Neg(dy2)), 2, batch);

  // 1/depth is linear on the screen. Double precision where the first corner is far outside.
  const VD inverse_area = hn::Div(hn::Set(d, 1.0), area);
  const VD z_dx = hn::Mul(hn::Sub(hn::Mul(dz1, dy2), hn::Mul(dz2, dy1)), inverse_area);
  const VD z_dy = hn::Mul(hn::Sub(hn::Mul(dz2, dx1), hn::Mul(dz1, dx2)), inverse_area);
  const VD z_origin = hn::Sub(hn::Sub(z[0], hn::Mul(z_dx, x[0])), hn::Mul(z_dy, y[0]));
  const VD per_pixel = hn::Set(d, static_cast<double>(kSubpixels));
  hn::Store(hn::DemoteTo(df, z_origin), df, batch.z);
  hn::Store(hn::DemoteTo(df, hn::Mul(z_dx, per_pixel)), df, batch.z_dx);
  hn::Store(hn::DemoteTo(df, hn::Mul(z_dy, per_pixel)), df, batch.z_dy);
}

// Draws triangle `lane` of the batch in vectors of at most kLanes pixels; `entry` is its position
// in the tile's list.
template <std::size_t kLanes>
HWY_INLINE void drawRows(const TriangleBatch& batch, std::size_t lane, std::int32_t entry,
                         TileBuffer& tile) {
  const hn::CappedTag<std::int32_t, kLanes> di;
  const hn::CappedTag<float, kLanes> df;
  const int lanes = static_cast<int>(hn::Lanes(di));
  const int x0 = batch.x0[lane], x1 = batch.x1[lane], y0 = batch.y0[lane], y1 = batch.y1[lane];
  const auto entry_v = hn::Set(di, entry);
  const auto b0 = hn::Set(di, batch.b[0][lane]), b1 = hn::Set(di, batch.b[1][lane]),
             b2 = hn::Set(di, batch.b[2][lane]);
  for (int x = x0; x <= x1; x += lanes) {
    const auto xs = hn::Add(hn::Iota(di, 0), hn::Set(di, x));  // Iota of a variable is slow
    const auto edge = [&](int i) HWY_ATTR {
      return hn::Add(hn::Set(di, batch.c[i][lane] + batch.b[i][lane] * y0),
                     hn::Mul(hn::Set(di, batch.a[i][lane]), xs));
    };
    auto e0 = edge(0), e1 = edge(1), e2 = edge(2);
    const auto z_x = hn::Mul(hn::Set(df, batch.z_dx[lane]), hn::ConvertTo(df, xs));
    const auto draw_row = [&](int y) HWY_ATTR {
      const int at = y * kRowStride + x;
      const auto z =
          hn::Add(hn::Set(df, batch.z[lane] + batch.z_dy[lane] * static_cast<float>(y)), z_x);
      const auto outside = hn::MaskFromVec(hn::BroadcastSignBit(hn::Or3(e0, e1, e2)));
      const auto pass =
          hn::AndNot(hn::RebindMask(df, outside), hn::Gt(z, hn::LoadU(df, tile.depth + at)));
      // The buffer is private to the tile: no other thread writes beside it.
      hn::BlendedStore(z, pass, df, tile.depth + at);
      hn::BlendedStore(entry_v, hn::RebindMask(di, pass), di, tile.nearest + at);
      e0 = hn::Add(e0, b0);
      e1 = hn::Add(e1, b1);
      e2 = hn::Add(e2, b2);
    };
    for (int y = y0; y <= y1; y += kRowGroup) {
      draw_row(y);
      draw_row(y + 1);
      draw_row(y + 2);
      draw_row(y + 3);
    }
  }
}

// Short vectors for narrow triangles: at any x, long ones nearly always straddle two cache lines.
HWY_INLINE void drawTriangle(const TriangleBatch& batch, std::size_t lane, std::int32_t entry,
                             TileBuffer& tile) {
  constexpr int kNarrow_px = 8;
  if (batch.x1[lane] - batch.x0[lane] < kNarrow_px)
    drawRows<kNarrow_px>(batch, lane, entry, tile);
  else
    drawRows<16>(batch, lane, entry, tile);
}

void clearTile(TileBuffer& tile) {
  std::fill_n(tile.depth, kRows * kRowStride, -std::numeric_limits<float>::infinity());
  std::fill_n(tile.nearest, kRows * kRowStride, static_cast<std::int32_t>(kNoEntry));
}

// Copies the rows to `nearest`, with kNoEntry outside the image, and counts covered pixels.
std::uint32_t storeTile(const TileBuffer& tile, int width_px, int height_px,
                        std::uint32_t* HWY_RESTRICT nearest) {
  const hn::ScalableTag<std::int32_t> di;
  const int lanes = static_cast<int>(hn::Lanes(di));
  const auto none = hn::Set(di, static_cast<std::int32_t>(kNoEntry));
  std::size_t covered = 0;
  for (int y = 0; y < kTileSize_px; ++y)
    for (int x = 0; x < kTileSize_px; x += lanes) {
      const int columns = y < height_px ? width_px : 0;
      const auto in_image = hn::Lt(hn::Iota(di, 0), hn::Set(di, columns - x));
      const auto value =
          hn::IfThenElse(in_image, hn::Load(di, tile.nearest + y * kRowStride + x), none);
      covered += hn::CountTrue(di, hn::Ne(value, none));
      hn::StoreU(value, di, reinterpret_cast<std::int32_t*>(nearest) + y * kTileSize_px + x);
    }
  return static_cast<std::uint32_t>(covered);
}

// Asks the cache for what gatherUnclipped will read of the entries [first, first + count).
HWY_INLINE void prefetchTriangles(const ProjectedMesh& mesh, std::span<const std::uint32_t> entries,
                                  std::size_t first, std::size_t count) {
  const std::size_t last = std::min(first + count, entries.size());
  for (std::size_t i = first; i < last; ++i)
    if (!(entries[i] & kClippedBit)) hwy::Prefetch(&mesh.mesh->triangles[entries[i]]);
}
HWY_INLINE void prefetchVertices(const ProjectedMesh& mesh, std::span<const std::uint32_t> entries,
                                 std::size_t first, std::size_t count) {
  const std::size_t last = std::min(first + count, entries.size());
  for (std::size_t i = first; i < last; ++i) {
    if (entries[i] & kClippedBit) continue;
    const glm::uvec3& t = mesh.mesh->triangles[entries[i]];
    for (int corner = 0; corner < 3; ++corner) hwy::Prefetch(&mesh.vertices[t[corner]]);
  }
}

std::uint32_t rasterizeOneTile(const ProjectedMesh& mesh, const TileBins& bins, std::size_t tile,
                               std::uint32_t* HWY_RESTRICT nearest) {
  const I32 di;
  const std::size_t lanes = hn::Lanes(di);
  const Projection& p = *mesh.projection;
  const int column = static_cast<int>(tile % static_cast<std::size_t>(p.tiles_x));
  const int row = static_cast<int>(tile / static_cast<std::size_t>(p.tiles_x));
  const std::int32_t tile_x = column * kTileSize_px * kSubpixels - p.origin_x;
  const std::int32_t tile_y = row * kTileSize_px * kSubpixels - p.origin_y;

  TileBuffer buffer;
  clearTile(buffer);
  const std::span<const std::uint32_t> entries = bins.entries(tile);
  TriangleBatch batch;
  prefetchTriangles(mesh, entries, 0, 4 * lanes);
  prefetchVertices(mesh, entries, 0, 2 * lanes);
  for (std::size_t i = 0; i < entries.size(); i += lanes) {
    prefetchTriangles(mesh, entries, i + 4 * lanes, lanes);
    prefetchVertices(mesh, entries, i + 2 * lanes, lanes);
    const VI entry = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(entries.data()) + i);
    const bool any_clipped = !hn::AllFalse(di, hn::Lt(entry, hn::Zero(di)));
    const Corners corners =
        any_clipped ? loadClipped(mesh, bins, entries.data() + i) : gatherUnclipped(mesh, entry);
    setUpTriangles(corners, tile_x, tile_y, batch);
    const std::size_t count = std::min(lanes, entries.size() - i);
    for (std::size_t lane = 0; lane < count; ++lane)
      drawTriangle(batch, lane, static_cast<std::int32_t>(i + lane), buffer);
  }
  return storeTile(buffer, p.width_px - column * kTileSize_px, p.height_px - row * kTileSize_px,
                   nearest);
}

}  // namespace glintmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glintmark {

HWY_EXPORT(rasterizeOneTile);

std::uint32_t rasterizeTile(const ProjectedMesh& mesh, const TileBins& bins, std::size_t tile,
                            std::uint32_t* nearest) {
  return HWY_DYNAMIC_DISPATCH(rasterizeOneTile)(mesh, bins, tile, nearest);
}

}  // namespace glintmark
#endif
