// Embree as the judge of visibility: which triangle does a pixel's ray hit first?
#pragma once
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "host/raster/rasterizer.h"
#include "tests/embree.h"
#include "tests/raster/ray_differentials.h"

namespace glintmark::test {

class EmbreeOracle {
 public:
  explicit EmbreeOracle(const TriangleMesh& mesh, RTCSceneFlags flags = RTC_SCENE_FLAG_ROBUST,
                        RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM)
      : device_(rtcNewDevice(nullptr)) {
    scene_ = rtcNewScene(device_);
    rtcSetSceneFlags(scene_, flags);
    rtcSetSceneBuildQuality(scene_, quality);
    RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* positions = static_cast<glm::vec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                sizeof(glm::vec3), mesh.positions.size()));
    auto* triangles = static_cast<glm::uvec3*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                sizeof(glm::uvec3), mesh.triangles.size()));
    if (!positions || !triangles) throw std::runtime_error("Embree has no memory for the mesh");
    std::copy(mesh.positions.begin(), mesh.positions.end(), positions);
    std::copy(mesh.triangles.begin(), mesh.triangles.end(), triangles);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene_);
  }
  ~EmbreeOracle() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
  }
  EmbreeOracle(const EmbreeOracle&) = delete;
  EmbreeOracle& operator=(const EmbreeOracle&) = delete;

  RTCScene scene() const { return scene_; }

  /// First triangle along the ray through pixel position (x, y), beyond the near plane, or
  /// kNoTriangle.
  std::uint32_t firstHit(const Camera& camera, double x, double y) const {
    const glm::vec3 origin(camera.eye), direction(camera.ray(x, y));
    RTCRayHit hit{};
    hit.ray.org_x = origin.x;
    hit.ray.org_y = origin.y;
    hit.ray.org_z = origin.z;
    hit.ray.dir_x = direction.x;
    hit.ray.dir_y = direction.y;
    hit.ray.dir_z = direction.z;
    hit.ray.tnear = static_cast<float>(camera.near_plane);  // dot(ray, forward) = 1
    hit.ray.tfar = INFINITY;
    hit.ray.mask = ~0u;
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(scene_, hit);
    return hit.hit.geomID == RTC_INVALID_GEOMETRY_ID ? kNoTriangle : hit.hit.primID;
  }

 private:
  RTCDevice device_;
  RTCScene scene_;
};

struct VisibilityComparison {
  std::size_t pixels = 0;
  std::size_t same = 0;
  std::size_t edge = 0;  // differs, within kEdgeDistance_px of an edge of one of the two
  std::size_t tie = 0;   // differs, both at the same distance
  std::size_t wrong = 0;
  int wrong_x = -1, wrong_y = -1;  // one of the wrong pixels
};

// Vertices are rounded to 1/256 px, which moves an edge by up to 0.5 * sqrt(2) / 256 = 0.0028 px;
// Embree works in single precision, whose error on the screen is of the same order.
inline constexpr double kEdgeDistance_px = 0.01;
// Both depth tests work in single precision.
inline constexpr double kDepthTie = 2e-6;
// How far rounding the vertices to 1/256 px may move a triangle.
inline constexpr double kSnap_px = 0.0028;

/// How much the depth of a triangle at pixel position (x, y) changes when it moves by kSnap_px.
inline double depthSnap(const TriangleMesh& mesh, std::uint32_t triangle, const Camera& camera,
                        double x, double y) {
  const double depth = hitPlane(mesh, triangle, camera, x, y).depth;
  return std::max(std::abs(hitPlane(mesh, triangle, camera, x + kSnap_px, y).depth - depth),
                  std::abs(hitPlane(mesh, triangle, camera, x, y + kSnap_px).depth - depth));
}

/// Compares Rasterizer::renderVisibility's `triangle_ids` (two-sided) with Embree, pixel by pixel.
inline VisibilityComparison compareWithEmbree(const EmbreeOracle& oracle, const TriangleMesh& mesh,
                                              const Camera& camera,
                                              const std::vector<std::uint32_t>& triangle_ids) {
  VisibilityComparison result;
  for (int y = 0; y < camera.height_px; ++y)
    for (int x = 0; x < camera.width_px; ++x) {
      const std::uint32_t ours =
          triangle_ids[static_cast<std::size_t>(y) * static_cast<std::size_t>(camera.width_px) +
                       static_cast<std::size_t>(x)];
      const std::uint32_t theirs = oracle.firstHit(camera, x, y);
      ++result.pixels;
      if (ours == theirs) {
        ++result.same;
        continue;
      }
      double distance = INFINITY;
      for (const std::uint32_t t : {ours, theirs})
        if (t != kNoTriangle)
          distance =
              std::min(distance, edgeDistance(hitPlane(mesh, t, camera, x, y), camera.near_plane));
      if (distance < kEdgeDistance_px) {
        ++result.edge;
        continue;
      }
      if (ours != kNoTriangle && theirs != kNoTriangle) {
        const double a = hitPlane(mesh, ours, camera, x, y).depth;
        const double b = hitPlane(mesh, theirs, camera, x, y).depth;
        const double snap =
            depthSnap(mesh, ours, camera, x, y) + depthSnap(mesh, theirs, camera, x, y);
        if (std::abs(a - b) <= kDepthTie * std::abs(b) + snap) {
          ++result.tie;
          continue;
        }
      }
      ++result.wrong;
      result.wrong_x = x;
      result.wrong_y = y;
    }
  return result;
}

}  // namespace glintmark::test
