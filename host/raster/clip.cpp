#include "host/raster/clip.h"

#include <array>
#include <cmath>

namespace glintmark {
namespace {

// A corner of the polygon that is being clipped, in homogeneous sub-pixels.
struct Corner {
  glm::dvec3 position;  // X, Y, w
  const ScreenVertex* unclipped = nullptr;
};

// Three corners and one more for each of the five planes, with room for what rounding may add.
struct Polygon {
  std::array<Corner, 16> corners;
  int count = 0;
  void add(const Corner& corner) { corners[static_cast<std::size_t>(count++)] = corner; }
};

// The near plane, then the sides of the guard band. One sub-pixel of slack: a vertex that rounds
// onto the band must not be clipped here while its neighbours' triangles take it as it is.
double distanceInside(int plane, const glm::dvec3& p, double near_plane) {
  constexpr double kSide = kGuardBand + 1.0;
  switch (plane) {
    case 0:
      return p.z - near_plane;
    case 1:
      return kSide * p.z - p.x;
    case 2:
      return kSide * p.z + p.x;
    case 3:
      return kSide * p.z - p.y;
    default:
      return kSide * p.z + p.y;
  }
}

// Always from inside to outside, so that both triangles of an edge find the same point.
glm::dvec3 crossing(const glm::dvec3& inside, double d_inside, const glm::dvec3& outside,
                    double d_outside) {
  return inside + (outside - inside) * (d_inside / (d_inside - d_outside));
}

// Sutherland-Hodgman against one plane.
Polygon clipAgainst(const Polygon& polygon, int plane, double near_plane) {
  Polygon result;
  for (int i = 0; i < polygon.count; ++i) {
    const Corner& a = polygon.corners[static_cast<std::size_t>(i)];
    const Corner& b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
    const double da = distanceInside(plane, a.position, near_plane);
    const double db = distanceInside(plane, b.position, near_plane);
    if (da >= 0) result.add(a);
    if (da >= 0 && db < 0) result.add({crossing(a.position, da, b.position, db)});
    if (da < 0 && db >= 0) result.add({crossing(b.position, db, a.position, da)});
  }
  return result;
}

ScreenVertex toScreen(const Corner& corner) {
  if (corner.unclipped) return *corner.unclipped;
  const double inverse_w = 1.0 / corner.position.z;
  return {static_cast<std::int32_t>(std::nearbyint(corner.position.x * inverse_w)),
          static_cast<std::int32_t>(std::nearbyint(corner.position.y * inverse_w)),
          static_cast<float>(inverse_w)};
}

}  // namespace

void clipTriangle(const Projection& projection, std::uint32_t triangle,
                  const glm::vec3 (&corners)[3], const ScreenVertex (&projected)[3],
                  std::vector<ClippedTriangle>& out) {
  Polygon polygon;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 p = projection.apply(glm::dvec3(corners[i]));
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return;
    polygon.add({p, projected[i].x == kNeedsClipping ? nullptr : &projected[i]});
  }
  for (int plane = 0; plane < 5 && polygon.count >= 3; ++plane)
    polygon = clipAgainst(polygon, plane, projection.near_plane);

  for (int i = 2; i < polygon.count; ++i)
    out.push_back(
        {{toScreen(polygon.corners[0]), toScreen(polygon.corners[static_cast<std::size_t>(i - 1)]),
          toScreen(polygon.corners[static_cast<std::size_t>(i)])},
         triangle});
}

}  // namespace glintmark
