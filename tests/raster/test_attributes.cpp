// uv, derivatives, depth and frames against double-precision ray differentials.
#include <gtest/gtest.h>

#include "tests/raster/ray_differentials.h"
#include "tests/raster/render_helpers.h"

namespace glintmark::test {
namespace {

// Fractions are stored in steps of 2^-32 and interpolated in double precision.
constexpr double kUvBound = 2e-9;
// Single precision: half a unit in the last place of the largest derivative of the pixel, with room
// for cancellation between its two terms.
constexpr double kDerivativeBound = 1e-6;
// Differences of corners' normals and their steps, both in single precision.
constexpr double kNormalStepBound = 3e-6;
constexpr double kDepthBound = 1e-6;
// Quantization of the frame (frame_packing.h: 4e-6) and single-precision interpolation.
constexpr double kFrameBound_rad = 5e-6;
// Pixels whose centre only rounding to 1/256 px brings inside get border attributes.
constexpr double kInside_px = 0.01;

void expectFrame(const PixelAttributes& a, const PlaneHit& hit) {
  EXPECT_LT(angleBetween(a.frame.normal, hit.normal), kFrameBound_rad);
  const glm::dvec3 tangent = hit.tangent - a.frame.normal * glm::dot(hit.tangent, a.frame.normal);
  EXPECT_LT(angleBetween(a.frame.tangent, tangent), kFrameBound_rad);
  EXPECT_EQ(a.mirrored, hit.mirrored);
  // The scalar reference, up to the rounding of single precision.
  const ShadingFrame reference = unpackFrame(packFrame(hit.normal, hit.tangent, hit.mirrored));
  EXPECT_LT(angleBetween(a.frame.normal, reference.normal), kFrameBound_rad);
  EXPECT_LT(angleBetween(a.frame.tangent, reference.tangent), kFrameBound_rad);
  EXPECT_LT(angleBetween(a.frame.bitangent, reference.bitangent), kFrameBound_rad);
}

// Checks every inner pixel; returns how many there were.
std::size_t expectAttributes(const TriangleMesh& mesh, const Camera& camera,
                             double uv_bound = kUvBound) {
  const PixelPlanes planes = renderAll(mesh, camera);
  std::vector<std::uint32_t> ids;
  Rasterizer(1).renderVisibility(mesh, camera, false, ids);
  std::size_t checked = 0;
  EXPECT_TRUE(allFinite(planes));
  forEachPixel(planes, [&](std::size_t entry, int x, int y, std::uint32_t) {
    const int at = y * camera.width_px + x;
    const std::uint32_t id = ids[static_cast<std::size_t>(at)];
    const PlaneHit hit = hitPlane(mesh, id, camera, x, y);
    if (edgeDistance(hit, camera.near_plane) < kInside_px || testing::Test::HasFailure()) return;
    ++checked;
    SCOPED_TRACE(testing::Message() << "pixel " << x << ", " << y << " of triangle " << id);
    const PixelAttributes a = readEntry(planes, entry);
    const glm::dvec2 whole = glm::floor(hit.uv);
    for (int i = 0; i < 2; ++i)
      EXPECT_NEAR(a.uv_floor[i] - whole[i] + a.uv_fraction[i], hit.uv[i] - whole[i], uv_bound);
    const double size = std::max({std::abs(hit.duv_dx.x), std::abs(hit.duv_dx.y),
                                  std::abs(hit.duv_dy.x), std::abs(hit.duv_dy.y)});
    EXPECT_LE(glm::length(a.duv_dx - hit.duv_dx), kDerivativeBound * size);
    EXPECT_LE(glm::length(a.duv_dy - hit.duv_dy), kDerivativeBound * size);
    const double length = glm::length(hit.normal);
    const double turn = std::max(glm::length(hit.dnormal_dx), glm::length(hit.dnormal_dy));
    EXPECT_LE(glm::length(a.normal_dx * length - hit.dnormal_dx), kNormalStepBound * (turn + 1e-3));
    EXPECT_LE(glm::length(a.normal_dy * length - hit.dnormal_dy), kNormalStepBound * (turn + 1e-3));
    EXPECT_NEAR(a.depth, hit.depth, kDepthBound * hit.depth);
    expectFrame(a, hit);
  });
  return checked;
}

TEST(Attributes, CurvedSurface) {
  const Camera camera = makeCamera(lookAt({0, -2.5, 2}, {0, 0, 0}), 320, 240);
  EXPECT_GT(expectAttributes(wavyTorus(50), camera), 10000u);
}

TEST(Attributes, TrianglesOfPixelSize) {
  const Camera camera = makeCamera(lookAt({0, -2.5, 2}, {0, 0, 0}), 160, 120);
  EXPECT_GT(expectAttributes(wavyTorus(150), camera), 2000u);
}

TEST(Attributes, FromInsideAndBehind) {
  const View view = lookAt({1, 0.02, 0.01}, {0.8, 1, 0.1}, 100, 1e-2);
  EXPECT_GT(expectAttributes(wavyTorus(50), makeCamera(view, 160, 120)), 10000u);
}

TEST(Attributes, GrazingPlaneThroughTheEyePlane) {
  TriangleMesh mesh;
  addQuad(mesh, {-40, 0, 40}, {80, 0, 0}, {0, 0, -80}, {-3, 7}, {50, 20});
  const Camera camera = makeCamera(lookAt({0, 0.2, 0}, {0.1, 0.18, -1}, 60, 1e-3), 160, 120);
  EXPECT_GT(expectAttributes(mesh, camera), 5000u);
}

TEST(Attributes, DerivativesPredictTheNeighbouringRay) {
  // The same statement without any formula for derivatives: central differences of the exact uv.
  TriangleMesh mesh;
  addQuad(mesh, {-4, 0, 4}, {8, 0, 0}, {0, 0, -8}, {0, 0}, {5, 3});
  const Camera camera = makeCamera(lookAt({0, 0.7, 3}, {0.1, 0, 0}), 64, 48);
  const PixelPlanes planes = renderAll(mesh, camera);
  constexpr double kStep_px = 1e-3;
  forEachPixel(planes, [&](std::size_t entry, int x, int y, std::uint32_t) {
    const PixelAttributes a = readEntry(planes, entry);
    const auto uv = [&](double dx, double dy) {
      return hitPlane(mesh, 0, camera, x + dx, y + dy).uv;
    };
    const glm::dvec2 dx = (uv(kStep_px, 0) - uv(-kStep_px, 0)) / (2 * kStep_px);
    const glm::dvec2 dy = (uv(0, kStep_px) - uv(0, -kStep_px)) / (2 * kStep_px);
    const double bound = 1e-5 * std::max(glm::length(dx), glm::length(dy));
    EXPECT_LT(glm::length(a.duv_dx - dx), bound);
    EXPECT_LT(glm::length(a.duv_dy - dy), bound);
  });
  EXPECT_GT(planes.covered_px, 500u);
}

TEST(Attributes, MillionUvsKeepCellsOfAMillionth) {
  // Two triangles span 1e6 uv and are seen so close that a pixel covers about one cell of 2^-20.
  TriangleMesh mesh;
  addQuad(mesh, {-512, -512, 0}, {1024, 0, 0}, {0, 1024, 0}, {-1e6, 123456}, {2e6, 1e6});
  View view = lookAt({200.001, -100.002, 4e-8}, {200.001, -100.002, 0}, 60, 1e-9);
  const Camera camera = makeCamera(view, 64, 64);
  const PixelPlanes planes = renderAll(mesh, camera);
  ASSERT_EQ(planes.covered_px, 64u * 64u);
  // An eighth of a cell.
  EXPECT_GT(expectAttributes(mesh, camera, std::ldexp(1.0, -23)), 4000u);
  const PixelAttributes a = readEntry(planes, 0);
  EXPECT_LT(std::abs(a.duv_dx.x), std::ldexp(1.0, -18));
}

TEST(Attributes, MillionUvsFromAfar) {
  TriangleMesh mesh;
  addQuad(mesh, {-512, -512, 0}, {1024, 0, 0}, {0, 1024, 0}, {-1e6, 123456}, {2e6, 1e6});
  const Camera camera = makeCamera(lookAt({0, -700, 30}, {0, 0, 0}, 60, 1e-2), 96, 64);
  EXPECT_GT(expectAttributes(mesh, camera, std::ldexp(1.0, -23)), 500u);
}

TEST(Attributes, NegativeUvsFloorDownwards) {
  TriangleMesh mesh;
  addQuad(mesh, {-50, -50, -1}, {100, 0, 0}, {0, 100, 0}, {-2.25, -0.5}, {0, 0});
  const PixelPlanes planes = renderAll(mesh, unitCamera(4, 4));
  ASSERT_EQ(planes.covered_px, 16u);
  const PixelAttributes a = readEntry(planes, 5);
  EXPECT_EQ(a.uv_floor, glm::dvec2(-3, -1));
  EXPECT_EQ(a.uv_fraction, glm::dvec2(0.75, 0.5));
}

TEST(Attributes, JustBelowAWholeNumberStaysBelow) {
  TriangleMesh mesh;
  addQuad(mesh, {-50, -50, -1}, {100, 0, 0}, {0, 100, 0}, {-1e-18, 1 - 1e-13}, {0, 0});
  const PixelPlanes planes = renderAll(mesh, unitCamera(4, 4));
  EXPECT_EQ(planes.plane<std::int32_t>(Plane::kUInt)[3], -1);
  EXPECT_EQ(planes.plane(Plane::kUFrac)[3], 0xFFFFFFFFu);
  EXPECT_EQ(planes.plane<std::int32_t>(Plane::kVInt)[3], 0);
  EXPECT_EQ(planes.plane(Plane::kVFrac)[3], 0xFFFFFFFFu);
}

TEST(Attributes, MirroredChartsSwapTheBitangent) {
  TriangleMesh mesh;
  addQuad(mesh, {-50, -50, -1}, {100, 0, 0}, {0, 100, 0});
  for (glm::vec4& t : mesh.tangents) t.w = -1;
  const PixelAttributes a = readEntry(renderAll(mesh, unitCamera(4, 4)), 0);
  EXPECT_TRUE(a.mirrored);
  EXPECT_LT(angleBetween(a.frame.bitangent, {0, -1, 0}), kFrameBound_rad);
}

TEST(Attributes, BackFaceTurnsNormalAndKeepsBitangent) {
  TriangleMesh mesh;
  addQuad(mesh, {-50, -50, -1}, {100, 0, 0}, {0, 100, 0});
  const PixelAttributes front = readEntry(renderAll(mesh, unitCamera(4, 4)), 0);
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  for (glm::vec3& n : mesh.normals) n = -n;
  for (glm::vec4& t : mesh.tangents) t.w = -1;  // n x t turns too, the bitangent does not
  const PixelAttributes back = readEntry(renderAll(mesh, unitCamera(4, 4)), 0);
  EXPECT_LT(angleBetween(back.frame.normal, front.frame.normal), kFrameBound_rad);
  EXPECT_LT(angleBetween(back.frame.tangent, front.frame.tangent), kFrameBound_rad);
  EXPECT_LT(angleBetween(back.frame.bitangent, front.frame.bitangent), kFrameBound_rad);
}

TEST(Attributes, ZeroNormalAndTangentStillGiveAFrame) {
  TriangleMesh mesh;
  addQuad(mesh, {-50, -50, -1}, {100, 0, 0}, {0, 100, 0});
  for (const float bad : {0.0f, std::numeric_limits<float>::quiet_NaN()}) {
    for (glm::vec3& n : mesh.normals) n = glm::vec3(bad);
    for (glm::vec4& t : mesh.tangents) t = glm::vec4(bad);
    const PixelPlanes planes = renderAll(mesh, unitCamera(4, 4));
    const PixelAttributes a = readEntry(planes, 0);
    EXPECT_NEAR(glm::length(a.frame.normal), 1, 1e-9);
    EXPECT_NEAR(glm::length(a.frame.tangent), 1, 1e-9);
  }
}

}  // namespace
}  // namespace glintmark::test
