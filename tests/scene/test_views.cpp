// The cameras of [ZK16] Table 1: `steep` looks straight onto the surface, `grazing` along it. What
// they see is asked of Embree.
#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/embree.h"
#include "tests/scene/scene_test_tools.h"

namespace glintmark {
namespace {

constexpr int kColumns = 96, kRows = 54;  // rays per view
constexpr double kAspect = 16.0 / 9.0;
// Folds and columns turn away from any camera, so the middle of what is seen counts.
constexpr double kSteepMedian_deg = 60;
constexpr double kGrazingMedianLow_deg = 4, kGrazingMedianHigh_deg = 20;
// Below this angle a flat surface's footprint is longer than 16:1, the paper's K_a.
const double kLimitAngle_deg = glm::degrees(std::asin(1.0 / 16));
constexpr double kLimitShare = 0.005;
constexpr double kCoveredShare = 0.85;
constexpr double kGlintShare = 0.75;
constexpr double kBackShare = 0.01;  // through gaps under the car and behind banners

struct Seen {
  std::vector<double> angles_deg;  // between ray and triangle, one per hit
  double covered = 0;              // share of the rays that hit anything
  double with_glints = 0;          // share of the rays that hit a glint material
  double from_behind = 0;          // share of the rays that hit a triangle's back
};

class Tracer {
 public:
  explicit Tracer(const Scene& scene)
      : scene_(scene), device_(rtcNewDevice(nullptr)), tree_(rtcNewScene(device_)) {
    const RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    const TriangleMesh& mesh = scene.mesh;
    auto* positions = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), mesh.positions.size()));
    std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
    auto* triangles = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), mesh.triangles.size()));
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(tree_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(tree_);
  }
  ~Tracer() {
    rtcReleaseScene(tree_);
    rtcReleaseDevice(device_);
  }
  Tracer(const Tracer&) = delete;
  Tracer& operator=(const Tracer&) = delete;

  Seen look(const View& view) const {
    const glm::dvec3 forward = glm::normalize(view.target - view.eye);
    const glm::dvec3 right = glm::normalize(glm::cross(forward, view.up));
    const glm::dvec3 up = glm::cross(right, forward);
    const double half_height = std::tan(glm::radians(0.5 * view.fov_y_deg));
    Seen seen;
    for (int y = 0; y < kRows; ++y) {
      for (int x = 0; x < kColumns; ++x) {
        // The outermost rays run through the frame's corners.
        const double sx = 2.0 * x / (kColumns - 1) - 1, sy = 1 - 2.0 * y / (kRows - 1);
        trace(view, forward + half_height * (kAspect * sx * right + sy * up), seen);
      }
    }
    seen.covered /= kColumns * kRows;
    seen.with_glints /= kColumns * kRows;
    seen.from_behind /= kColumns * kRows;
    std::sort(seen.angles_deg.begin(), seen.angles_deg.end());
    return seen;
  }

 private:
  void trace(const View& view, const glm::dvec3& direction, Seen& seen) const {
    const glm::vec3 eye = view.eye, towards = direction;
    RTCRayHit query{};
    query.ray.org_x = eye.x, query.ray.org_y = eye.y, query.ray.org_z = eye.z;
    query.ray.dir_x = towards.x, query.ray.dir_y = towards.y, query.ray.dir_z = towards.z;
    query.ray.tnear = static_cast<float>(view.near_plane);
    query.ray.tfar = 1e30f;
    query.ray.mask = 0xFFFFFFFFu;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    test::intersect(tree_, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return;
    const glm::dvec3 normal =
        glm::normalize(glm::dvec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
    const double towards_eye = -glm::dot(normal, glm::normalize(direction));
    const double sine = std::abs(towards_eye);
    if (towards_eye < 0) seen.from_behind += 1;
    seen.angles_deg.push_back(glm::degrees(std::asin(std::min(sine, 1.0))));
    seen.covered += 1;
    const std::uint32_t material = scene_.mesh.triangle_materials[query.hit.primID];
    if (scene_.materials[material].has_glints) seen.with_glints += 1;
  }

  const Scene& scene_;
  RTCDevice device_;
  RTCScene tree_;
};

double median(const std::vector<double>& sorted) {
  return sorted[sorted.size() / 2];
}

class TableOneViews : public testing::TestWithParam<const char*> {};

TEST_P(TableOneViews, SteepAndGrazing) {
  const Scene scene = load(GetParam());
  const Tracer tracer(scene);
  const Seen steep = tracer.look(scene.view("steep"));
  const Seen grazing = tracer.look(scene.view("grazing"));
  for (const Seen* seen : {&steep, &grazing}) {
    EXPECT_GE(seen->covered, kCoveredShare);
    EXPECT_GE(seen->with_glints, kGlintShare);
    EXPECT_LE(seen->from_behind, kBackShare);
    ASSERT_FALSE(seen->angles_deg.empty());
  }
  EXPECT_GE(median(steep.angles_deg), kSteepMedian_deg);
  EXPECT_GE(median(grazing.angles_deg), kGrazingMedianLow_deg);
  EXPECT_LE(median(grazing.angles_deg), kGrazingMedianHigh_deg);
  const auto beyond_limit =
      std::lower_bound(grazing.angles_deg.begin(), grazing.angles_deg.end(), kLimitAngle_deg) -
      grazing.angles_deg.begin();
  EXPECT_GE(beyond_limit / static_cast<double>(grazing.angles_deg.size()), kLimitShare);
}

INSTANTIATE_TEST_SUITE_P(ZK16, TableOneViews,
                         testing::Values("screen_plane", "snow", "dress", "car", "sponza"),
                         [](const auto& test) { return test.param; });

TEST(Views, ThePlaneFillsTheFrameAtEveryAngle) {
  const Scene scene = load("screen_plane");
  const Tracer tracer(scene);
  for (const double angle_deg : {90.0, 60.0, 45.0, 30.0, 20.0, 10.0, 5.0, 3.0, 2.0, 1.5, 1.0}) {
    for (const double azimuth_deg : {0.0, 30.0, 45.0, 200.0}) {
      Orbit orbit = *scene.view("sweep").orbit;
      orbit.angle_deg = angle_deg;
      orbit.azimuth_deg = azimuth_deg;
      const Seen seen = tracer.look(orbitView(scene.view("sweep"), orbit));
      EXPECT_EQ(seen.covered, 1) << angle_deg << " degrees, azimuth " << azimuth_deg;
      EXPECT_NEAR(median(seen.angles_deg), angle_deg, 1);
    }
  }
}

TEST(Views, TheSteepPlaneIsOneUvUnitWide) {
  for (const char* name : {"steep", "sweep"}) {
    const View view = load("screen_plane").view(name);
    const double width = 2 * kAspect * std::tan(glm::radians(0.5 * view.fov_y_deg)) *
                         glm::distance(view.eye, view.target);
    EXPECT_NEAR(width, 1, 0.01) << name;
  }
}

TEST(Views, OrbitAngles) {
  for (const glm::dvec3& normal :
       {glm::dvec3(0, 1, 0), glm::dvec3(0, 0, 2), glm::dvec3(1, 2, -3), glm::dvec3(-1, 0, 0)}) {
    for (const double angle_deg : {90.0, 45.0, 10.0, 0.5}) {
      const Orbit orbit{{1, 2, 3}, normal, angle_deg, 70, 5};
      View base;
      base.name = "kept";
      base.fov_y_deg = 33;
      const View view = orbitView(base, orbit);
      const glm::dvec3 axis = view.target - view.eye;
      EXPECT_EQ(view.name, "kept");
      EXPECT_EQ(view.fov_y_deg, 33);
      EXPECT_EQ(view.target, orbit.target);
      EXPECT_NEAR(glm::length(axis), 5, 1e-12);
      EXPECT_NEAR(glm::degrees(std::asin(-glm::dot(axis, glm::normalize(normal)) / 5)), angle_deg,
                  1e-6);
      EXPECT_NEAR(glm::dot(axis, view.up), 0, 1e-12);
      EXPECT_NEAR(glm::length(view.up), 1, 1e-12);
    }
  }
}

TEST(Views, OrbitConventions) {
  View view = orbitView({}, {{0, 0, 0}, {0, 1, 0}, 30, 0, 1});
  EXPECT_NEAR(view.eye.z, std::cos(glm::radians(30.0)), 1e-12);  // azimuth 0: the eye is at +z
  EXPECT_GT(view.up.y, 0);
  view = orbitView({}, {{0, 0, 0}, {0, 1, 0}, 30, 90, 1});
  EXPECT_NEAR(view.eye.x, std::cos(glm::radians(30.0)), 1e-12);  // 90: at +x
  view = orbitView({}, {{0, 0, 0}, {0, 0, 1}, 90, 0, 1});
  EXPECT_NEAR(view.up.y, 1, 1e-12);  // a wall is seen upright
}

TEST(Views, BadOrbits) {
  expectMessage(errorOf([] { orbitView({}, {{}, {0, 1, 0}, 0, 0, 1}); }), {"(0, 90]"});
  expectMessage(errorOf([] { orbitView({}, {{}, {0, 1, 0}, 91, 0, 1}); }), {"(0, 90]"});
  expectMessage(errorOf([] { orbitView({}, {{}, {0, 1, 0}, 45, 0, 0}); }), {"above 0"});
  expectMessage(errorOf([] { orbitView({}, {{}, {0, 0, 0}, 45, 0, 1}); }), {"not 0"});
}

}  // namespace
}  // namespace glintmark
