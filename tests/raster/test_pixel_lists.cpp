// Layout of the planes: lists, padding, order, determinism, reuse.
#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <set>

#include "host/core/error.h"
#include "tests/raster/render_helpers.h"

namespace glintmark::test {
namespace {

constexpr int kTile_px = 32;

// Between SIMD targets: four steps of the stored fraction of uv; a few units in the last place of
// single precision, of the largest derivative for derivatives; two steps of quantized frames.
const double kAlikeUv = std::ldexp(4.0, -32);
constexpr double kAlikeFloat = 5e-7;
constexpr double kAlikeFrame_rad = 5e-6;

TriangleMesh patchwork() {
  TriangleMesh mesh;
  const std::uint32_t materials[] = {4, 1, 7, 1, 4, 2};
  for (int j = 0; j < 12; ++j)
    for (int i = 0; i < 12; ++i)
      addQuad(mesh, glm::vec3(-90 + 15.3 * i, -60 + 9.1 * j, -1), {15.3, 0, 0}, {0, 9.1, 0}, {0, 0},
              {1, 1}, materials[(7 * i + 5 * j) % 6]);
  return mesh;
}

TEST(PixelLists, EveryCoveredPixelOnceUnderItsMaterial) {
  const TriangleMesh mesh = patchwork();
  const Camera camera = unitCamera(201, 133);
  const PixelPlanes planes = renderAll(mesh, camera);
  std::vector<std::uint32_t> ids;
  Rasterizer(1).renderVisibility(mesh, camera, false, ids);
  std::set<std::pair<int, int>> seen;
  forEachPixel(planes, [&](std::size_t, int x, int y, std::uint32_t material) {
    EXPECT_TRUE(seen.insert({x, y}).second);
    const int at = y * camera.width_px + x;
    const std::uint32_t id = ids[static_cast<std::size_t>(at)];
    ASSERT_NE(id, kNoTriangle);
    EXPECT_EQ(mesh.triangle_materials[id], material);
  });
  const auto covered =
      std::count_if(ids.begin(), ids.end(), [](auto id) { return id != kNoTriangle; });
  EXPECT_EQ(planes.covered_px, std::size_t(covered));
  EXPECT_EQ(seen.size(), planes.covered_px);
  EXPECT_EQ(planes.lists.size(), 4u);
  EXPECT_LT(planes.covered_px, ids.size());
}

TEST(PixelLists, PaddedAndAscending) {
  const PixelPlanes planes = renderAll(patchwork(), unitCamera(201, 133));
  std::uint32_t end = 0;
  for (std::size_t i = 0; i < planes.lists.size(); ++i) {
    const PixelList& list = planes.lists[i];
    EXPECT_EQ(list.offset, end);
    EXPECT_GT(list.count, 0u);
    if (i > 0) {
      EXPECT_GT(list.material, planes.lists[i - 1].material);
    }
    end = (list.offset + list.count + GM_LIST_PADDING - 1) / GM_LIST_PADDING * GM_LIST_PADDING;
    for (std::size_t p = 0; p < kPlaneCount; ++p)
      for (std::uint32_t k = list.offset + list.count; k < end; ++k) {
        const auto plane = planes.plane(static_cast<Plane>(p));
        EXPECT_EQ(plane[k], plane[list.offset + list.count - 1]);
      }
  }
  EXPECT_EQ(planes.stride, end);
  EXPECT_EQ(planes.stride % GM_LIST_PADDING, 0u);
}

TEST(PixelLists, TileByTileRowByRow) {
  const PixelPlanes planes = renderAll(patchwork(), unitCamera(201, 133));
  const auto pixel = planes.plane(Plane::kPixel);
  const auto key = [](std::uint32_t p) {
    const std::uint32_t x = p & 0xFFFF, y = p >> 16;
    return std::array{y / kTile_px, x / kTile_px, y, x};
  };
  for (const PixelList& list : planes.lists)
    for (std::uint32_t i = list.offset + 1; i < list.offset + list.count; ++i)
      EXPECT_LT(key(pixel[i - 1]), key(pixel[i]));
}

TEST(PixelLists, OnlyAskedPlanesTakeRoom) {
  TriangleMesh mesh;
  addQuad(mesh, {-500, -500, -1}, {1000, 0, 0}, {0, 1000, 0});
  const Camera camera = unitCamera(64, 64);
  const PixelPlanes all = renderAll(mesh, camera);
  for (const PlaneMask mask :
       {PlaneMask{}, PlaneMask{Plane::kDepth}, PlaneMask{Plane::kUInt, Plane::kUFrac},
        PlaneMask{Plane::kFrame0, Plane::kFrame1}, PlaneMask{Plane::kDudx, Plane::kDvdy}}) {
    const PixelPlanes some = renderAll(mesh, camera, false, 1, mask);
    EXPECT_EQ(some.mask, (mask | PlaneMask{Plane::kPixel}));
    EXPECT_LE(some.storage.capacity(), some.mask.size() * some.stride * 9 / 8);
    EXPECT_EQ(some.stride, 64u * 64u);
    for (std::size_t p = 0; p < kPlaneCount; ++p) {
      const auto plane = static_cast<Plane>(p);
      if (!some.mask.has(plane)) continue;
      EXPECT_TRUE(std::ranges::equal(some.plane(plane), all.plane(plane))) << p;
    }
  }
}

TEST(PixelLists, EmptyMeshGivesNoLists) {
  const PixelPlanes planes = renderAll(TriangleMesh{}, unitCamera(64, 64));
  EXPECT_EQ(planes.covered_px, 0u);
  EXPECT_EQ(planes.stride, 0u);
  EXPECT_TRUE(planes.lists.empty());
  EXPECT_EQ(planes.width_px, 64);
}

TEST(PixelLists, OnePixelImage) {
  TriangleMesh mesh;
  addQuad(mesh, {-5, -5, -1}, {10, 0, 0}, {0, 10, 0});
  const PixelPlanes planes = renderAll(mesh, unitCamera(1, 1));
  ASSERT_EQ(planes.lists.size(), 1u);
  EXPECT_EQ(planes.lists[0].count, 1u);
  EXPECT_EQ(planes.stride, GM_LIST_PADDING);
}

TEST(Determinism, OneAndTwoThreads) {
  const TriangleMesh mesh = wavyTorus(200);
  const Camera camera = makeCamera(lookAt({0, -2.5, 2}, {0, 0, 0}), 400, 300);
  const PixelPlanes one = renderAll(mesh, camera, false, 1);
  for (int run = 0; run < 5; ++run) EXPECT_TRUE(identical(one, renderAll(mesh, camera, false, 2)));
}

void expectAlike(const PixelPlanes& a, const PixelPlanes& b) {
  ASSERT_EQ(a.covered_px, b.covered_px);
  ASSERT_EQ(a.lists.size(), b.lists.size());
  forEachPixel(a, [&](std::size_t i, int, int, std::uint32_t) {
    if (testing::Test::HasFailure()) return;
    ASSERT_EQ(a.plane(Plane::kPixel)[i], b.plane(Plane::kPixel)[i]);
    const PixelAttributes p = readEntry(a, i), q = readEntry(b, i);
    for (int axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(p.uv_floor[axis] - q.uv_floor[axis] + p.uv_fraction[axis], q.uv_fraction[axis],
                  kAlikeUv);
    const double size = std::max(
        {std::abs(p.duv_dx.x), std::abs(p.duv_dx.y), std::abs(p.duv_dy.x), std::abs(p.duv_dy.y)});
    EXPECT_LE(glm::length(p.duv_dx - q.duv_dx), kAlikeFloat * size);
    EXPECT_LE(glm::length(p.duv_dy - q.duv_dy), kAlikeFloat * size);
    EXPECT_NEAR(p.depth, q.depth, kAlikeFloat * p.depth);
    EXPECT_LT(angleBetween(p.frame.normal, q.frame.normal), kAlikeFrame_rad);
    EXPECT_LT(angleBetween(p.frame.tangent, q.frame.tangent), kAlikeFrame_rad);
    EXPECT_EQ(p.mirrored, q.mirrored);
  });
}

// Targets differ in fused sums and in estimates of reciprocals, hence in the last bits of
// attributes: what a pixel sees is the same everywhere.
TEST(Determinism, AnySimdTarget) {
  const TriangleMesh mesh = wavyTorus(100);
  // Near and close to the surface: clipped, large and tiny triangles.
  const Camera camera = makeCamera(lookAt({1, 0.02, 0.01}, {0.8, 1, 0.1}, 100, 1e-2), 200, 150);
  const PixelPlanes best = renderAll(mesh, camera);
  std::vector<std::uint32_t> best_ids, ids;
  Rasterizer().renderVisibility(mesh, camera, false, best_ids);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(target);
    Rasterizer().renderVisibility(mesh, camera, false, ids);
    EXPECT_EQ(best_ids, ids);
    expectAlike(best, renderAll(mesh, camera));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

TEST(Reuse, BuffersStayAndResultsDoNotLeak) {
  const TriangleMesh torus = wavyTorus(80);
  const Camera small = makeCamera(lookAt({0, -2.5, 2}, {0, 0, 0}), 150, 100);
  const Camera large = makeCamera(lookAt({0, -2.0, 2}, {0, 0, 0}), 400, 300);
  Rasterizer rasterizer(2);
  PixelPlanes planes;
  rasterizer.render(torus, large, false, PlaneMask::all(), planes);
  const std::uint32_t* memory = planes.storage.data();
  rasterizer.render(patchwork(), unitCamera(64, 48), true, PlaneMask{Plane::kDepth}, planes);
  rasterizer.render(torus, small, false, PlaneMask::all(), planes);
  EXPECT_TRUE(identical(planes, renderAll(torus, small)));
  rasterizer.render(TriangleMesh{}, small, false, PlaneMask::all(), planes);
  EXPECT_EQ(planes.covered_px, 0u);
  rasterizer.render(torus, large, false, PlaneMask::all(), planes);
  EXPECT_TRUE(identical(planes, renderAll(torus, large)));
  EXPECT_EQ(planes.storage.data(), memory);
}

TEST(BadMesh, MissingArraysAreAnError) {
  const Camera camera = unitCamera(8, 8);
  TriangleMesh mesh;
  addQuad(mesh, {-5, -5, -1}, {10, 0, 0}, {0, 10, 0});
  TriangleMesh bad = mesh;
  bad.uvs.clear();
  EXPECT_THROW(renderAll(bad, camera), Error);
  bad = mesh;
  bad.triangle_materials.pop_back();
  EXPECT_THROW(renderAll(bad, camera), Error);
  bad = mesh;
  bad.triangle_materials[0] = 0xFFFFFFFFu;
  EXPECT_THROW(renderAll(bad, camera), Error);
}

}  // namespace
}  // namespace glintmark::test
