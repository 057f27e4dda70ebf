#include "host/raster/rasterizer.h"

#include <fmt/format.h>
#ifdef __linux__
#include <sys/mman.h>
#endif
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <vector>

#include "host/core/error.h"
#include "host/core/stopwatch.h"
#include "host/raster/attribute_table.h"
#include "host/raster/binning.h"
#include "host/raster/pixel_attributes.h"
#include "host/raster/projection.h"
#include "host/raster/tile_pixels.h"
#include "host/raster/tile_visibility.h"
#include "host/raster/transform.h"

namespace glintmark {
namespace {

constexpr std::size_t kTransformGrain = 8192;
// 3 * index and 4 * index are computed in 32 bits.
constexpr std::size_t kMaxIndex = std::size_t{1} << 29;
constexpr std::uint32_t kMaxMaterials = 4096;

void checkMesh(const TriangleMesh& mesh) {
  const std::size_t n = mesh.positions.size();
  if (mesh.normals.size() != n || mesh.tangents.size() != n || mesh.uvs.size() != n)
    throw Error(
        fmt::format("a mesh to draw needs as many normals, tangents and uvs as positions ({})", n));
  if (mesh.triangle_materials.size() != mesh.triangles.size())
    throw Error(
        fmt::format("a mesh to draw needs one material per triangle ({})", mesh.triangles.size()));
  if (n > kMaxIndex || mesh.triangles.size() > kMaxIndex)
    throw Error(
        fmt::format("a mesh to draw may have at most {} vertices and triangles", kMaxIndex));
}

// Kernels read a dozen planes side by side, each on a page of its own: small pages cost the glints
// of a full screen a fifteenth of their time in look-ups of addresses. Advice before the first
// touch, which a system may ignore.
void adviseLargePages([[maybe_unused]] const PlaneStorage& storage) {
#ifdef MADV_HUGEPAGE
  if (storage.capacity() > 0) ::madvise(storage.data(), storage.capacity() * 4, MADV_HUGEPAGE);
#endif
}

std::uint32_t materialCount(const TriangleMesh& mesh) {
  std::uint32_t highest = 0;
  for (const std::uint32_t material : mesh.triangle_materials)
    highest = std::max(highest, material);
  if (highest >= kMaxMaterials)
    throw Error(fmt::format("material index {} of a mesh to draw is too large: at most {}", highest,
                            kMaxMaterials - 1));
  return highest + 1;
}

// What one thread needs to resolve a tile.
struct ResolveScratch {
  TilePixels pixels;
  AttributeTable table;
};

}  // namespace

struct Rasterizer::Impl {
  explicit Impl(int thread_count)
      : arena(thread_count > 0 ? thread_count : static_cast<int>(tbb::task_arena::automatic)) {}

  template <class Body>
  void parallelFor(std::size_t count, std::size_t grain, const Body& body) {
    arena.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, count, grain),
          [&](const tbb::blocked_range<std::size_t>& range) { body(range); },
          tbb::simple_partitioner());
    });
  }

  // Runs body(i) for every i in [0, count).
  template <class Body>
  void forEach(std::size_t count, const Body& body) {
    parallelFor(count, 1, [&](const tbb::blocked_range<std::size_t>& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
    });
  }

  RasterStats setUp(const TriangleMesh& mesh, const Camera& camera, bool cull_back_faces);
  void findVisible();
  void layOut(PlaneMask mask, PixelPlanes& out);
  void resolve(const Camera& camera, PixelPlanes& out);
  void resolveTile(const Camera& camera, std::size_t tile, PixelPlanes& out);
  static void padLists(PixelPlanes& out);

  tbb::task_arena arena;
  Projection projection;
  ProjectedMesh projected;
  std::vector<ScreenVertex> vertices;
  TileBins bins;
  std::vector<std::uint32_t> nearest;  // kTilePixels per tile: positions in the tile's list
  std::uint32_t material_count = 1;
  std::vector<std::uint32_t> tile_offsets;  // per tile and material: count, then first entry
  std::vector<std::unique_ptr<ResolveScratch>> scratch;  // per thread
};

RasterStats Rasterizer::Impl::setUp(const TriangleMesh& mesh, const Camera& camera,
                                    bool cull_back_faces) {
  const Stopwatch watch;
  checkMesh(mesh);
  material_count = materialCount(mesh);
  projection = makeProjection(camera);
  if (vertices.size() < mesh.positions.size()) vertices.resize(mesh.positions.size());
  const std::span<ScreenVertex> screen(vertices.data(), mesh.positions.size());
  parallelFor(mesh.positions.size(), kTransformGrain,
              [&](const tbb::blocked_range<std::size_t>& range) {
                transformVertices(projection,
                                  std::span(mesh.positions).subspan(range.begin(), range.size()),
                                  screen.subspan(range.begin(), range.size()));
              });

  projected = {&mesh, &projection, screen, cull_back_faces};
  bins.start(mesh.triangleCount(), static_cast<std::size_t>(projection.tiles_x) *
                                       static_cast<std::size_t>(projection.tiles_y));
  forEach(bins.chunkCount(), [&](std::size_t chunk) { bins.collect(projected, chunk); });
  bins.merge();
  forEach(bins.chunkCount(), [&](std::size_t chunk) { bins.scatter(chunk); });

  RasterStats stats;
  stats.setup_ns = watch.elapsedNs();
  stats.triangles_in = mesh.triangleCount();
  stats.triangles_drawn = bins.drawnCount();
  return stats;
}

void Rasterizer::Impl::findVisible() {
  const std::size_t tiles = bins.tileCount();
  if (nearest.size() < tiles * kTilePixels) nearest.resize(tiles * kTilePixels);
  tile_offsets.assign(tiles * material_count, 0);
  forEach(tiles, [&](std::size_t tile) {
    std::uint32_t* pixels = nearest.data() + tile * kTilePixels;
    const std::uint32_t covered = rasterizeTile(projected, bins, tile, pixels);
    std::uint32_t* counts = tile_offsets.data() + tile * material_count;
    if (material_count == 1)
      counts[0] = covered;
    else if (covered > 0)
      countTileMaterials(projected, bins, tile, pixels, counts);
  });
}

// Turns counts into first entries and makes room: material by material, then tile by tile.
void Rasterizer::Impl::layOut(PlaneMask mask, PixelPlanes& out) {
  out.width_px = projection.width_px;
  out.height_px = projection.height_px;
  out.mask = mask | PlaneMask{Plane::kPixel};
  out.lists.clear();
  out.covered_px = 0;
  std::uint32_t entry = 0;
  for (std::uint32_t material = 0; material < material_count; ++material) {
    const std::uint32_t first = entry;
    for (std::size_t tile = 0; tile < bins.tileCount(); ++tile) {
      std::uint32_t& at = tile_offsets[tile * material_count + material];
      const std::uint32_t count = at;
      at = entry;
      entry += count;
    }
    if (entry == first) continue;
    out.lists.push_back({material, first, entry - first});
    out.covered_px += entry - first;
    entry = (entry + GM_LIST_PADDING - 1) / GM_LIST_PADDING * GM_LIST_PADDING;
  }
  out.stride = entry;
  if (out.storage.reserve(out.stride * out.mask.size())) adviseLargePages(out.storage);
}

void Rasterizer::Impl::resolveTile(const Camera& camera, std::size_t tile, PixelPlanes& out) {
  const auto thread = static_cast<std::size_t>(tbb::this_task_arena::current_thread_index());
  if (!scratch[thread]) scratch[thread] = std::make_unique<ResolveScratch>();
  ResolveScratch& s = *scratch[thread];
  collectTilePixels(projected, bins, tile, nearest.data() + tile * kTilePixels, s.pixels);
  if (s.pixels.pixel_count == 0) return;
  const bool with_frame = out.mask.hasAnyOf(kFramePlanes);
  setUpAttributes(*projected.mesh, camera, s.pixels.triangles, s.pixels.triangle_count, with_frame,
                  s.table);
  for (const MaterialRun& run : s.pixels.runs)
    writeAttributes(s.table, s.pixels, run.first, run.count,
                    tile_offsets[tile * material_count + run.material], out);
}

void Rasterizer::Impl::resolve(const Camera& camera, PixelPlanes& out) {
  scratch.resize(static_cast<std::size_t>(arena.max_concurrency()));
  forEach(bins.tileCount(), [&](std::size_t tile) { resolveTile(camera, tile, out); });
  padLists(out);
}

void Rasterizer::Impl::padLists(PixelPlanes& out) {
  for (std::size_t slot = 0; slot < out.mask.size(); ++slot) {
    std::uint32_t* plane = out.storage.data() + slot * out.stride;
    for (const PixelList& list : out.lists) {
      const std::uint32_t end = list.offset + list.count;
      const std::uint32_t padded = (end + GM_LIST_PADDING - 1) / GM_LIST_PADDING * GM_LIST_PADDING;
      std::fill(plane + end, plane + padded, plane[end - 1]);
    }
  }
}

Rasterizer::Rasterizer(int thread_count) : impl_(std::make_unique<Impl>(thread_count)) {}
Rasterizer::~Rasterizer() = default;
Rasterizer::Rasterizer(Rasterizer&&) noexcept = default;
Rasterizer& Rasterizer::operator=(Rasterizer&&) noexcept = default;

RasterStats Rasterizer::render(const TriangleMesh& mesh, const Camera& camera, bool cull_back_faces,
                               PlaneMask mask, PixelPlanes& out) {
  RasterStats stats = impl_->setUp(mesh, camera, cull_back_faces);
  const Stopwatch visibility;
  impl_->findVisible();
  stats.visibility_ns = visibility.elapsedNs();

  const Stopwatch resolve;
  impl_->layOut(mask, out);
  impl_->resolve(camera, out);
  stats.resolve_ns = resolve.elapsedNs();
  return stats;
}

RasterStats Rasterizer::renderVisibility(const TriangleMesh& mesh, const Camera& camera,
                                         bool cull_back_faces,
                                         std::vector<std::uint32_t>& triangle_ids) {
  RasterStats stats = impl_->setUp(mesh, camera, cull_back_faces);
  const Stopwatch visibility;
  const Projection& p = impl_->projection;
  const auto width = static_cast<std::size_t>(p.width_px);
  triangle_ids.resize(width * static_cast<std::size_t>(p.height_px));
  impl_->forEach(impl_->bins.tileCount(), [&](std::size_t tile) {
    alignas(64) std::uint32_t nearest[kTilePixels];
    rasterizeTile(impl_->projected, impl_->bins, tile, nearest);
    const std::span<const std::uint32_t> entries = impl_->bins.entries(tile);
    const std::size_t x0 = tile % static_cast<std::size_t>(p.tiles_x) * kTileSize_px;
    const std::size_t y0 = tile / static_cast<std::size_t>(p.tiles_x) * kTileSize_px;
    const std::size_t x1 = std::min(x0 + kTileSize_px, width);
    const std::size_t y1 = std::min(y0 + kTileSize_px, static_cast<std::size_t>(p.height_px));
    for (std::size_t y = y0; y < y1; ++y)
      for (std::size_t x = x0; x < x1; ++x) {
        const std::uint32_t at = nearest[(y - y0) * kTileSize_px + (x - x0)];
        triangle_ids[y * width + x] =
            at == kNoEntry ? kNoTriangle : impl_->bins.triangle(entries[at]);
      }
  });
  stats.visibility_ns = visibility.elapsedNs();
  return stats;
}

}  // namespace glintmark
