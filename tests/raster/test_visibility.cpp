// Which triangle does each pixel see? Against Embree, and exact rules on shared edges.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/raster/embree_oracle.h"
#include "tests/raster/test_meshes.h"

namespace glintmark::test {
namespace {

std::vector<std::uint32_t> visibility(const TriangleMesh& mesh, const Camera& camera,
                                      bool cull_back_faces = false, int threads = 0) {
  std::vector<std::uint32_t> ids;
  Rasterizer(threads).renderVisibility(mesh, camera, cull_back_faces, ids);
  return ids;
}

void expectAgreement(const TriangleMesh& mesh, const Camera& camera, double least_covered) {
  const EmbreeOracle oracle(mesh);
  const auto ids = visibility(mesh, camera);
  const auto r = compareWithEmbree(oracle, mesh, camera, ids);
  EXPECT_EQ(r.wrong, 0u) << "e.g. at " << r.wrong_x << ", " << r.wrong_y;
  EXPECT_EQ(r.tie, 0u);
  // Edge pixels are those within 0.01 px of an edge: a small share even of tiny triangles.
  EXPECT_LT(double(r.edge), 0.05 * double(r.pixels));
  const auto covered =
      std::count_if(ids.begin(), ids.end(), [](auto id) { return id != kNoTriangle; });
  EXPECT_GT(double(covered), least_covered * double(r.pixels));
}

TEST(VisibilityAgainstEmbree, Torus) {
  expectAgreement(wavyTorus(60), makeCamera(lookAt({0, -2.5, 2}, {0, 0, 0}), 640, 480), 0.2);
}

TEST(VisibilityAgainstEmbree, TrianglesOfPixelSize) {
  expectAgreement(wavyTorus(400), makeCamera(lookAt({0, -2.5, 2}, {0, 0, 0}), 640, 480), 0.2);
}

TEST(VisibilityAgainstEmbree, InsideTheTorus) {
  const View view = lookAt({1, 0.02, 0.01}, {0.8, 1, 0.1}, 100, 1e-2);
  expectAgreement(wavyTorus(60), makeCamera(view, 640, 480), 0.99);
}

TEST(VisibilityAgainstEmbree, NearPlaneCutsTheSurface) {
  const View view = lookAt({0, -2.5, 2}, {0, 0, 0}, 45, 2.7);
  expectAgreement(wavyTorus(60), makeCamera(view, 640, 480), 0.1);
}

TEST(VisibilityAgainstEmbree, RandomTriangleSoup) {
  std::mt19937 rng(3);
  std::uniform_real_distribution<float> at(-2, 2), side(-0.7f, 0.7f);
  TriangleMesh mesh;
  for (int i = 0; i < 3000; ++i) {
    const glm::vec3 p(at(rng), at(rng), at(rng));
    addTriangle(mesh, p, p + glm::vec3(side(rng), side(rng), side(rng)),
                p + glm::vec3(side(rng), side(rng), side(rng)));
  }
  // From the middle of it: triangles behind, around and through the eye.
  for (const auto& target : {glm::dvec3(1, 0.2, 0.1), glm::dvec3(-0.3, 0.2, -1)}) {
    const Camera camera = makeCamera(lookAt({0.1, 0.2, 0.3}, target, 80, 1e-2), 400, 300);
    const EmbreeOracle oracle(mesh);
    const auto r = compareWithEmbree(oracle, mesh, camera, visibility(mesh, camera));
    // Triangles cut each other: within rounding of a cut line both are at the same depth.
    EXPECT_EQ(r.wrong, 0u) << "e.g. at " << r.wrong_x << ", " << r.wrong_y;
    EXPECT_LE(r.tie, 20u);
  }
}

TEST(VisibilityAgainstEmbree, GroundToTheHorizon) {
  TriangleMesh mesh;
  // The diagonal stays out of sight: single precision, Embree's, loses metres of it.
  addQuad(mesh, {-1e6, 0, 2e6}, {2e6, 0, 0}, {0, 0, -3e6});
  expectAgreement(mesh, makeCamera(lookAt({0, 1.5, 0}, {0.3, 1.4, -1}, 60, 0.01), 320, 240), 0.3);
}

// Draws every triangle alone and counts how often each pixel is covered.
std::vector<int> coverCounts(const TriangleMesh& mesh, const Camera& camera) {
  std::vector<int> counts(static_cast<std::size_t>(camera.width_px * camera.height_px), 0);
  Rasterizer rasterizer(1);
  TriangleMesh one = mesh;
  std::vector<std::uint32_t> ids;
  for (const glm::uvec3& t : mesh.triangles) {
    one.triangles = {t};
    one.triangle_materials = {0};
    rasterizer.renderVisibility(one, camera, false, ids);
    for (std::size_t i = 0; i < ids.size(); ++i) counts[i] += ids[i] != kNoTriangle;
  }
  return counts;
}

void expectOnce(const std::vector<int>& counts) {
  EXPECT_EQ(std::count(counts.begin(), counts.end(), 1), std::ptrdiff_t(counts.size()));
}

TEST(Watertight, FanAroundAPixelCentre) {
  TriangleMesh mesh;
  const std::uint32_t hub = addVertex(mesh, {0, 0, -1}, {0, 0});  // a pixel centre of an odd grid
  constexpr int kBlades = 37;
  for (int i = 0; i < kBlades; ++i) {
    const double a = 2 * std::numbers::pi * i / kBlades;
    addVertex(mesh, glm::vec3(100 * std::cos(a), 100 * std::sin(a), -1), {0, 0});
  }
  for (std::uint32_t i = 0; i < kBlades; ++i)
    addTriangle(mesh, hub, hub + 1 + i, hub + 1 + (i + 1) % kBlades);
  expectOnce(coverCounts(mesh, unitCamera(65, 65)));
}

TEST(Watertight, JitteredGridInBothWindings) {
  TriangleMesh mesh;
  std::mt19937 rng(5);
  std::uniform_real_distribution<float> jitter(-0.8f, 0.8f), depth(0.5f, 20.0f);
  constexpr int kHalf = 12, kSide = 2 * kHalf;
  for (int j = 0; j <= kSide; ++j)
    for (int i = 0; i <= kSide; ++i) {
      // The same silhouette at any depth: the grid stays a partition of the screen.
      const float z = depth(rng);
      addVertex(
          mesh,
          glm::vec3(float(i - kHalf) * 4 + jitter(rng), float(j - kHalf) * 4 + jitter(rng), -1) * z,
          {0, 0});
    }
  for (std::uint32_t j = 0; j < kSide; ++j)
    for (std::uint32_t i = 0; i < kSide; ++i) {
      const std::uint32_t a = j * (kSide + 1) + i, b = a + 1, c = a + kSide + 2, d = a + kSide + 1;
      addTriangle(mesh, a, b, c);
      addTriangle(mesh, a, d, c);  // the other winding
    }
  expectOnce(coverCounts(mesh, unitCamera(83, 83)));
}

TEST(Watertight, CoarseVerticesOnPixelCentres) {
  TriangleMesh mesh;
  // Vertices and edges run through pixel centres: only the top-left rule keeps hits single.
  for (int j = -40; j < 40; j += 8)
    for (int i = -40; i < 40; i += 8) addQuad(mesh, glm::vec3(i, j, -1), {8, 0, 0}, {0, 8, 0});
  expectOnce(coverCounts(mesh, unitCamera(79, 79)));
}

TEST(Watertight, AcrossTheNearPlane) {
  // A fan whose hub is behind the eye: every blade is clipped, edges are shared.
  TriangleMesh mesh;
  const std::uint32_t hub = addVertex(mesh, {0.03f, 0.02f, 2}, {0, 0});
  constexpr std::uint32_t kBlades = 11;
  for (std::uint32_t i = 0; i < kBlades; ++i) {
    const double a = 2 * std::numbers::pi * i / kBlades;
    addVertex(mesh, glm::vec3(50 * std::cos(a), 50 * std::sin(a), -2), {0, 0});
  }
  for (std::uint32_t i = 0; i < kBlades; ++i)
    addTriangle(mesh, hub, hub + 1 + i, hub + 1 + (i + 1) % kBlades);
  const Camera camera = makeCamera(lookAt({0, 0, 0}, {0, 0, -1}, 100, 1e-3), 120, 90);
  const auto counts = coverCounts(mesh, camera);
  // A cone seen from within its mouth: nothing twice, and the hole in the middle is convex.
  EXPECT_LE(*std::max_element(counts.begin(), counts.end()), 1);
  for (int y = 0; y < camera.height_px; ++y) {
    int changes = 0;
    for (int x = 1; x < camera.width_px; ++x) {
      const int at = y * camera.width_px + x;
      changes += counts[static_cast<std::size_t>(at)] != counts[static_cast<std::size_t>(at - 1)];
    }
    EXPECT_LE(changes, 2) << "row " << y;
  }
}

TEST(TopLeftRule, QuadOnPixelCentres) {
  // Corners on the centres of pixels (2, 1) and (6, 4) of an 8 x 8 image: left and top edges are
  // drawn, right and bottom ones are not.
  const auto centre = [](double x, double y) { return glm::vec3(x - 3.5, 3.5 - y, -1); };
  TriangleMesh mesh;
  addQuad(mesh, centre(2, 4), {4, 0, 0}, {0, 3, 0});
  const auto ids = visibility(mesh, unitCamera(8, 8));
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x)
      EXPECT_EQ(ids[static_cast<std::size_t>(8 * y + x)] != kNoTriangle,
                x >= 2 && x < 6 && y >= 1 && y < 4)
          << x << ", " << y;
}

TEST(Visibility, NearerTriangleWinsInAnyOrder) {
  for (const float first_z : {-2.0f, -3.0f}) {
    TriangleMesh mesh;
    addQuad(mesh, {-50, -50, first_z}, {100, 0, 0}, {0, 100, 0});
    addQuad(mesh, {-50, -50, -5 - first_z}, {100, 0, 0}, {0, 100, 0});
    const auto ids = visibility(mesh, unitCamera(16, 16));
    for (const std::uint32_t id : ids) EXPECT_EQ(id / 2, first_z == -2.0f ? 0u : 1u);
  }
}

TEST(Visibility, LowestIndexWinsATie) {
  TriangleMesh mesh;
  for (int i = 0; i < 20000; ++i)  // several chunks
    addTriangle(mesh, {-50, -50, -1}, {150, -50, -1}, {-50, 150, -1});
  for (const int threads : {1, 2})
    for (const std::uint32_t id : visibility(mesh, unitCamera(8, 8), false, threads))
      EXPECT_EQ(id, 0u);
}

TEST(Visibility, BackFacesAreCulledOnRequestOnly) {
  TriangleMesh mesh;
  addTriangle(mesh, {-50, -50, -1}, {50, -50, -1}, {0, 90, -1});  // counter-clockwise: front
  addTriangle(mesh, {-50, -50, -2}, {0, 90, -2}, {50, -50, -2});  // back
  const Camera camera = unitCamera(5, 5);
  EXPECT_EQ(visibility(mesh, camera, true)[12], 0u);
  std::swap(mesh.triangles[0].y, mesh.triangles[0].z);
  EXPECT_EQ(visibility(mesh, camera, true)[12], kNoTriangle);
  EXPECT_EQ(visibility(mesh, camera, false)[12], 0u);
}

TEST(Visibility, BackFacesAreCulledBehindTheNearPlaneToo) {
  // Reaches behind the eye, so it goes through the clipper.
  TriangleMesh mesh;
  addTriangle(mesh, {-50, -1, 5}, {50, -1, 5}, {0, -1, -50});
  const Camera camera = unitCamera(5, 5);
  const std::size_t bottom = 22;
  EXPECT_EQ(visibility(mesh, camera, true)[bottom], 0u);
  std::swap(mesh.triangles[0].y, mesh.triangles[0].z);
  EXPECT_EQ(visibility(mesh, camera, true)[bottom], kNoTriangle);
  EXPECT_EQ(visibility(mesh, camera, false)[bottom], 0u);
}

}  // namespace
}  // namespace glintmark::test
