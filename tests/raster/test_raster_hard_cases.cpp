// Triangles that break careless rasterizers.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "tests/raster/ray_differentials.h"
#include "tests/raster/render_helpers.h"

namespace glintmark::test {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

std::size_t coveredBy(const TriangleMesh& mesh, const Camera& camera) {
  const PixelPlanes planes = renderAll(mesh, camera);
  EXPECT_TRUE(allFinite(planes));
  return planes.covered_px;
}

TEST(HardTriangles, DegenerateOnesCoverNothing) {
  TriangleMesh mesh;
  addTriangle(mesh, {-5, -5, -1}, {-5, -5, -1}, {5, 5, -1});
  addTriangle(mesh, {0, 0, -1}, {0, 0, -1}, {0, 0, -1});
  addTriangle(mesh, {-5, -5, -1}, {0, 0, -1}, {5, 5, -1});
  EXPECT_EQ(coveredBy(mesh, unitCamera(16, 16)), 0u);
}

TEST(HardTriangles, NotANumberAndInfinityAreDropped) {
  for (const float bad : {kNan, kInf, -kInf})
    for (int axis = 0; axis < 3; ++axis) {
      TriangleMesh mesh;
      addTriangle(mesh, {-50, -50, -1}, {50, -50, -1}, {0, 90, -1});
      EXPECT_EQ(coveredBy(mesh, unitCamera(16, 16)), 256u);
      mesh.positions[1][axis] = bad;
      EXPECT_EQ(coveredBy(mesh, unitCamera(16, 16)), 0u);
    }
}

TEST(HardTriangles, BehindTheEyeIsInvisible) {
  TriangleMesh mesh;
  addTriangle(mesh, {-50, -50, 1}, {50, -50, 1}, {0, 90, 1});
  addTriangle(mesh, {-50, -50, -1e-4f}, {50, -50, -1e-4f}, {0, 90, -1e-4f});  // before near plane
  EXPECT_EQ(coveredBy(mesh, unitCamera(16, 16)), 0u);
}

TEST(HardTriangles, VertexInTheEye) {
  TriangleMesh mesh;
  addTriangle(mesh, {0, 0, 0}, {50, -1, -50}, {-50, -1, -50});
  const PixelPlanes planes = renderAll(mesh, unitCamera(33, 33));
  EXPECT_TRUE(allFinite(planes));
}

TEST(HardTriangles, PlaneThroughTheEyeIsFinite) {
  // Edge-on: only rounding could show it.
  TriangleMesh mesh;
  addTriangle(mesh, {-3, 0, -1}, {5, 0, -7}, {1, 0, -20});
  addTriangle(mesh, {-3, 1e-30f, -1}, {5, 1e-30f, -7}, {1, -1e-30f, -20});
  addTriangle(mesh, {-3, 1e-3f, -1}, {5, -1e-3f, -7}, {1, 2e-3f, -20});
  const Camera camera = makeCamera(lookAt({0, 0, 0}, {0, 0, -1}, 90), 65, 65);
  coveredBy(mesh, camera);
}

TEST(HardTriangles, SliversStayInsideTheirUvs) {
  std::mt19937 rng(11);
  std::uniform_real_distribution<float> at(-30, 30), thin(-2e-3f, 2e-3f), depth(1, 30);
  TriangleMesh mesh;
  for (int i = 0; i < 4000; ++i) {
    const float z0 = depth(rng), z1 = depth(rng);
    const glm::vec3 a = glm::vec3(at(rng), at(rng), -1) * z0;
    const glm::vec3 b = glm::vec3(at(rng), at(rng), -1) * z1;
    addTriangle(mesh, a, b, 0.5f * (a + b) + glm::vec3(thin(rng), thin(rng), thin(rng)));
  }
  const PixelPlanes planes = renderAll(mesh, unitCamera(64, 64));
  EXPECT_TRUE(allFinite(planes));
  EXPECT_GT(planes.covered_px, 50u);
  forEachPixel(planes, [&](std::size_t entry, int, int, std::uint32_t) {
    const PixelAttributes a = readEntry(planes, entry);
    // Barycentrics are held in [0, 1] each.
    EXPECT_GE(a.uv_floor.x, 0);
    EXPECT_LE(a.uv_floor.x + a.uv_fraction.x, 1);
    EXPECT_GT(a.depth, 0);
    EXPECT_LE(a.depth, 31);
  });
}

TEST(HardTriangles, HugeCoordinates) {
  // A ground plane of 2e6 units below an eye at 1.5: each pixel below the horizon is covered and
  // says which of the two triangles and where.
  TriangleMesh mesh;
  addQuad(mesh, {-1e6, 0, 1e6}, {2e6, 0, 0}, {0, 0, -2e6}, {0, 0}, {2e6, 2e6});
  const Camera camera = makeCamera(lookAt({0.5, 1.5, 0}, {0.8, 1.45, -1}, 60, 0.01), 96, 64);
  const PixelPlanes planes = renderAll(mesh, camera);
  EXPECT_TRUE(allFinite(planes));
  std::size_t below_horizon = 0;
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = 0; x < camera.width_px; ++x) below_horizon += camera.ray(x, y).y < -1e-5;
  EXPECT_EQ(planes.covered_px, below_horizon);
  forEachPixel(planes, [&](std::size_t entry, int x, int y, std::uint32_t) {
    const PixelAttributes a = readEntry(planes, entry);
    const glm::dvec3 ray = camera.ray(x, y);
    const glm::dvec3 p = camera.eye + ray * (-camera.eye.y / ray.y);
    // Positions are exact; what is left is the rounding of 2e6 in double precision.
    EXPECT_NEAR(a.uv_floor.x + a.uv_fraction.x, p.x + 1e6, 1e-6 * (1 + std::abs(p.z)));
    EXPECT_NEAR(a.uv_floor.y + a.uv_fraction.y, 1e6 - p.z, 1e-6 * (1 + std::abs(p.z)));
  });
}

TEST(HardTriangles, HugeOnScreen) {
  // Far outside of the guard band on every side.
  TriangleMesh mesh;
  addTriangle(mesh, {-3e6, -1e6, -1}, {3e6, -1e6, -1}, {0, 4e6, -1});
  EXPECT_EQ(coveredBy(mesh, unitCamera(200, 100)), 20000u);
  EXPECT_EQ(coveredBy(mesh, unitCamera(16384, 1)), 16384u);
}

TEST(HardTriangles, PastTheGuardBandTheEdgeIsExact) {
  // A diagonal that runs from far away through the image: below it, and only there, are pixels.
  TriangleMesh mesh;
  addTriangle(mesh, {-1e6, -1e6, -1}, {1e6, -1e6, -1}, {1e6, 1e6, -1});
  const Camera camera = unitCamera(64, 64);
  std::vector<std::uint32_t> ids;
  Rasterizer(1).renderVisibility(mesh, camera, false, ids);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const int at = 64 * y + x;
      const bool covered = ids[static_cast<std::size_t>(at)] == 0;
      if (x + y == 63) continue;
      EXPECT_EQ(covered, x + y > 63) << x << ", " << y;
    }
}

TEST(HardTriangles, LargeImage) {
  TriangleMesh mesh = wavyTorus(16);
  const Camera camera = makeCamera(lookAt({0, -2.5, 2}, {0, 0, 0}), 8192, 8192);
  std::vector<std::uint32_t> large, small;
  Rasterizer().renderVisibility(mesh, camera, false, large);
  // Every 64th pixel of the large image is a pixel of a small one with the same rays.
  Camera coarse = makeCamera(lookAt({0, -2.5, 2}, {0, 0, 0}), 128, 128);
  coarse.ray_origin = camera.ray_origin;
  coarse.ray_dx = camera.ray_dx * 64.0;
  coarse.ray_dy = camera.ray_dy * 64.0;
  Rasterizer().renderVisibility(mesh, coarse, false, small);
  std::size_t different = 0;
  for (std::size_t y = 0; y < 128; ++y)
    for (std::size_t x = 0; x < 128; ++x)
      different += large[(64 * y) * 8192 + 64 * x] != small[128 * y + x];
  // Positions are rounded to 1/256 px of either grid, so edge pixels may differ.
  EXPECT_LT(different, 30u);
  EXPECT_GT(std::count_if(small.begin(), small.end(), [](auto id) { return id != kNoTriangle; }),
            3000);
}

TEST(HardTriangles, ManyLayersNearestWins) {
  TriangleMesh mesh;
  for (int i = 0; i < 300; ++i)
    addQuad(mesh, {-900, -900, -1.0f - static_cast<float>((i * 97) % 300) * 0.01f}, {1800, 0, 0},
            {0, 1800, 0});
  std::vector<std::uint32_t> ids;
  Rasterizer().renderVisibility(mesh, unitCamera(40, 40), false, ids);
  for (const std::uint32_t id : ids) EXPECT_EQ(id / 2, 0u);
}

}  // namespace
}  // namespace glintmark::test
