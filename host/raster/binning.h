// Sorts triangles into screen tiles.
//
// Triangles are cut into chunks of consecutive indices. Every chunk culls and lists its triangles
// on its own (TileBins::collect); then a counting sort brings all lists together (merge, scatter),
// so that each tile sees its triangles in ascending order whatever the number of threads.
#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "host/raster/clip.h"
#include "host/raster/projection.h"
#include "host/scene/scene.h"

namespace glintmark {

/// An entry of a tile's list: the index of a triangle, or with this bit set of a ClippedTriangle.
inline constexpr std::uint32_t kClippedBit = 0x80000000u;

/// Entries that may be read, not used, past the end of every list: the widest SIMD batch.
inline constexpr std::size_t kListSlack = 16;

/// What the stages after projection read.
struct ProjectedMesh {
  const TriangleMesh* mesh = nullptr;
  const Projection* projection = nullptr;
  std::span<const ScreenVertex> vertices;
  bool cull_back_faces = false;
};

/// A triangle that may cover pixels of a tile.
struct TileEntry {
  std::uint32_t tile;
  std::uint32_t entry;
};

/// What one chunk of triangles found.
struct BinChunk {
  std::size_t first = 0, last = 0;  // triangles [first, last)
  std::vector<TileEntry> entries;   // the first entry_count are valid
  std::size_t entry_count = 0;
  std::vector<std::uint32_t> tile_counts;  // entries per tile; after merge: where the next one goes
  std::vector<ClippedTriangle> clipped;
  std::uint32_t clipped_base = 0;  // index of clipped[0] among those of all chunks
  std::size_t drawn = 0;           // triangles with at least one entry, pieces counted apart
};

class TileBins {
 public:
  /// Cuts the mesh into chunks and forgets the last frame.
  void start(std::size_t triangle_count, std::size_t tile_count);
  std::size_t chunkCount() const { return chunk_count_; }
  /// Step 1, any chunks at the same time: cull, clip, list.
  void collect(const ProjectedMesh& mesh, std::size_t chunk);
  /// Step 2, once: where every list begins.
  void merge();
  /// Step 3, any chunks at the same time: entries to their lists.
  void scatter(std::size_t chunk);

  std::size_t tileCount() const { return tile_count_; }
  std::span<const std::uint32_t> entries(std::size_t tile) const {
    return {entries_.data() + begins_[tile], begins_[tile + 1] - begins_[tile]};
  }
  /// Triangle of an entry.
  std::uint32_t triangle(std::uint32_t entry) const {
    return entry & kClippedBit ? clipped_[entry & ~kClippedBit].triangle : entry;
  }
  const ClippedTriangle& clipped(std::uint32_t entry) const {
    return clipped_[entry & ~kClippedBit];
  }
  std::size_t drawnCount() const;

 private:
  std::size_t tile_count_ = 0, chunk_count_ = 0;
  std::vector<BinChunk> chunks_;
  std::vector<ClippedTriangle> clipped_;
  std::vector<std::size_t> begins_;
  std::vector<std::uint32_t> entries_;
};

}  // namespace glintmark
