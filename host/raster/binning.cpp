#include "host/raster/binning.h"

#include <algorithm>
#include <limits>

#include "host/core/error.h"
#include "host/raster/triangle_culling.h"

namespace glintmark {
namespace {

constexpr std::size_t kMinChunkTriangles = 4096;
constexpr std::size_t kMaxChunks = 64;

struct PixelRect {
  std::int32_t x0, y0, x1, y1;  // inclusive
};

class Collector {
 public:
  Collector(const ProjectedMesh& mesh, BinChunk& chunk) : mesh_(mesh), chunk_(chunk) {}

  void add(std::uint32_t entry, const PixelRect& rect, const ScreenVertex& a, const ScreenVertex& b,
           const ScreenVertex& c) {
    // Most triangles of a fine mesh.
    if (((rect.x0 ^ rect.x1) | (rect.y0 ^ rect.y1)) < kTileSize_px) {
      reserve(1);
      ++chunk_.drawn;
      push(rect.x0 / kTileSize_px, rect.y0 / kTileSize_px, entry);
    } else {
      addToManyTiles(entry, rect, a, b, c);
    }
  }

  // Pieces of a triangle that reaches behind the near plane or out of the guard band.
  void addClipped(std::uint32_t triangle) {
    const glm::uvec3& t = mesh_.mesh->triangles[triangle];
    const auto& positions = mesh_.mesh->positions;
    const std::size_t first_piece = chunk_.clipped.size();
    clipTriangle(*mesh_.projection, triangle, {positions[t.x], positions[t.y], positions[t.z]},
                 {mesh_.vertices[t.x], mesh_.vertices[t.y], mesh_.vertices[t.z]}, chunk_.clipped);
    for (std::size_t i = first_piece; i < chunk_.clipped.size(); ++i) {
      const auto& v = chunk_.clipped[i].vertices;
      PixelRect rect;
      if (visibleRect(v[0], v[1], v[2], rect))
        add(static_cast<std::uint32_t>(i) | kClippedBit, rect, v[0], v[1], v[2]);
    }
  }

 private:
  void addToManyTiles(std::uint32_t entry, const PixelRect& rect, const ScreenVertex& a,
                      const ScreenVertex& b, const ScreenVertex& c) {
    const int tx0 = rect.x0 / kTileSize_px, tx1 = rect.x1 / kTileSize_px;
    const int ty0 = rect.y0 / kTileSize_px, ty1 = rect.y1 / kTileSize_px;
    reserve(static_cast<std::size_t>(tx1 - tx0 + 1) * static_cast<std::size_t>(ty1 - ty0 + 1));
    ++chunk_.drawn;
    if (tx0 == tx1 || ty0 == ty1) {
      for (int ty = ty0; ty <= ty1; ++ty)
        for (int tx = tx0; tx <= tx1; ++tx) push(tx, ty, entry);
    } else {
      addTouched(entry, tx0, ty0, tx1, ty1, a, b, c);
    }
  }

  void reserve(std::size_t more) {
    if (chunk_.entry_count + more > chunk_.entries.size())
      chunk_.entries.resize(std::max(chunk_.entry_count + more, 2 * chunk_.entries.size()));
  }

  void push(int tx, int ty, std::uint32_t entry) {
    const auto tile = static_cast<std::uint32_t>(ty * mesh_.projection->tiles_x + tx);
    chunk_.entries[chunk_.entry_count++] = {tile, entry};
    ++chunk_.tile_counts[tile];
  }

  // The same decisions as cullTriangles.
  bool visibleRect(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c,
                   PixelRect& rect) const {
    const Projection& p = *mesh_.projection;
    const std::int64_t area =
        std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
    if (area == 0 || (mesh_.cull_back_faces && area > 0)) return false;
    const auto [min_x, max_x] = std::minmax({a.x, b.x, c.x});
    const auto [min_y, max_y] = std::minmax({a.y, b.y, c.y});
    rect.x0 = std::max((min_x + p.origin_x + kSubpixels - 1) >> kSubpixelBits, 0);
    rect.y0 = std::max((min_y + p.origin_y + kSubpixels - 1) >> kSubpixelBits, 0);
    rect.x1 = std::min((max_x + p.origin_x) >> kSubpixelBits, p.width_px - 1);
    rect.y1 = std::min((max_y + p.origin_y) >> kSubpixelBits, p.height_px - 1);
    return rect.x0 <= rect.x1 && rect.y0 <= rect.y1;
  }

  // Of the tiles of a rectangle, only those that no edge has wholly on its outer side.
  void addTouched(std::uint32_t entry, int tx0, int ty0, int tx1, int ty1, const ScreenVertex& a,
                  const ScreenVertex& b, const ScreenVertex& c) {
    const Projection& p = *mesh_.projection;
    const double area = double(b.x - a.x) * (c.y - a.y) - double(c.x - a.x) * (b.y - a.y);
    const ScreenVertex* corners[4] = {&a, &b, &c, &a};
    double step_x[3], step_y[3], value[3];
    for (int i = 0; i < 3; ++i) {
      const ScreenVertex &from = *corners[i], &to = *corners[i + 1];
      const double sign = area > 0 ? 1 : -1;
      const double dx = sign * (to.x - from.x), dy = sign * (to.y - from.y);
      // Largest value over the pixel centres of tile (0, 0), then its change per tile.
      constexpr double kExtent = double(kSubpixels) * (kTileSize_px - 1);
      value[i] = dx * (-p.origin_y - from.y) - dy * (-p.origin_x - from.x) +
                 std::max(0.0, dx) * kExtent + std::max(0.0, -dy) * kExtent;
      step_x[i] = -dy * kSubpixels * kTileSize_px;
      step_y[i] = dx * kSubpixels * kTileSize_px;
    }
    for (int ty = ty0; ty <= ty1; ++ty)
      for (int tx = tx0; tx <= tx1; ++tx) {
        bool touched = true;
        for (int i = 0; i < 3; ++i) touched &= value[i] + step_x[i] * tx + step_y[i] * ty >= 0;
        if (touched) push(tx, ty, entry);
      }
  }

  const ProjectedMesh& mesh_;
  BinChunk& chunk_;
};

}  // namespace

void TileBins::start(std::size_t triangle_count, std::size_t tile_count) {
  tile_count_ = tile_count;
  const std::size_t chunk_size =
      std::max(kMinChunkTriangles, (triangle_count + kMaxChunks - 1) / kMaxChunks);
  chunk_count_ = (triangle_count + chunk_size - 1) / chunk_size;
  if (chunks_.size() < chunk_count_) chunks_.resize(chunk_count_);
  for (std::size_t i = 0; i < chunk_count_; ++i) {
    chunks_[i].first = i * chunk_size;
    chunks_[i].last = std::min(triangle_count, (i + 1) * chunk_size);
  }
}

void TileBins::collect(const ProjectedMesh& mesh, std::size_t chunk_index) {
  BinChunk& chunk = chunks_[chunk_index];
  chunk.entry_count = 0;
  chunk.drawn = 0;
  chunk.clipped.clear();
  chunk.tile_counts.assign(tile_count_, 0);

  Collector collector(mesh, chunk);
  CullBatch batch;
  for (std::size_t first = chunk.first; first < chunk.last; first += kCullBatch) {
    const std::size_t count = std::min(kCullBatch, chunk.last - first);
    cullTriangles(mesh, first, count, batch);
    for (std::size_t i = 0; i < count; ++i) {
      const auto triangle = static_cast<std::uint32_t>(first + i);
      const glm::uvec3& t = mesh.mesh->triangles[triangle];
      if (batch.result[i] == static_cast<std::uint32_t>(CullResult::kVisible))
        collector.add(triangle, {batch.x0[i], batch.y0[i], batch.x1[i], batch.y1[i]},
                      mesh.vertices[t.x], mesh.vertices[t.y], mesh.vertices[t.z]);
      else if (batch.result[i] == static_cast<std::uint32_t>(CullResult::kClip))
        collector.addClipped(triangle);
    }
  }
}

void TileBins::merge() {
  begins_.resize(tile_count_ + 1);
  std::size_t position = 0;
  for (std::size_t tile = 0; tile < tile_count_; ++tile) {
    begins_[tile] = position;
    for (std::size_t c = 0; c < chunk_count_; ++c) {
      std::uint32_t& count = chunks_[c].tile_counts[tile];
      const std::uint32_t here = count;
      count = static_cast<std::uint32_t>(position);
      position += here;
    }
  }
  begins_[tile_count_] = position;
  if (position > std::numeric_limits<std::uint32_t>::max())
    throw Error("the mesh covers the screen too many times over: at most 2^32 triangle-tile pairs");
  if (entries_.size() < position + kListSlack)
    entries_.resize(position + position / 8 + kListSlack);
  std::fill_n(entries_.begin() + static_cast<std::ptrdiff_t>(position), kListSlack, 0u);

  clipped_.clear();
  for (std::size_t c = 0; c < chunk_count_; ++c) {
    chunks_[c].clipped_base = static_cast<std::uint32_t>(clipped_.size());
    clipped_.insert(clipped_.end(), chunks_[c].clipped.begin(), chunks_[c].clipped.end());
  }
}

void TileBins::scatter(std::size_t chunk_index) {
  BinChunk& chunk = chunks_[chunk_index];
  for (std::size_t i = 0; i < chunk.entry_count; ++i) {
    const TileEntry& e = chunk.entries[i];
    const std::uint32_t entry = e.entry & kClippedBit ? e.entry + chunk.clipped_base : e.entry;
    entries_[chunk.tile_counts[e.tile]++] = entry;
  }
}

std::size_t TileBins::drawnCount() const {
  std::size_t drawn = 0;
  for (std::size_t c = 0; c < chunk_count_; ++c) drawn += chunks_[c].drawn;
  return drawn;
}

}  // namespace glintmark
