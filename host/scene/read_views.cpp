#include "host/core/error.h"
#include "host/scene/read_scene_parts.h"

namespace glintmark {
namespace {

constexpr Range kFieldOfView{0.001, 179};
constexpr Range kOrbitAngle{0, 90, true};

void readOrbit(SceneTable& table, SceneTable& orbit_table, View& view) {
  for (const char* key : {"eye", "target", "up"}) {
    if (table.has(key)) table.fail(key, "comes with an orbit, expected one or the other");
  }
  Orbit orbit;
  orbit.target = orbit_table.vector3("target", orbit.target);
  orbit.normal = orbit_table.vector3("normal", orbit.normal);
  orbit.angle_deg = orbit_table.number("angle_deg", orbit.angle_deg, kOrbitAngle);
  orbit.azimuth_deg = orbit_table.number("azimuth_deg", orbit.azimuth_deg);
  orbit.distance = orbit_table.number("distance", orbit.distance, kPositive);
  if (orbit.normal == glm::dvec3(0)) {
    orbit_table.fail("normal", "is 0, expected the surface's normal");
  }
  orbit_table.finish();
  view = orbitView(view, orbit);
}

View readView(SceneTable& table) {
  View view;
  view.name = table.text("name");
  if (view.name.empty()) table.fail("name", "is missing, expected the view's name");
  view.fov_y_deg = table.number("fov_y_deg", view.fov_y_deg, kFieldOfView);
  view.near_plane = table.number("near_plane", view.near_plane, kPositive);
  if (std::optional<SceneTable> orbit = table.table("orbit")) {
    readOrbit(table, *orbit, view);
  } else {
    view.eye = table.vector3("eye", view.eye);
    view.target = table.vector3("target", view.target);
    view.up = table.vector3("up", view.up);
    const glm::dvec3 axis = view.target - view.eye;
    if (glm::length(axis) == 0) table.fail("eye", "is the target, expected two different points");
    if (glm::length(glm::cross(axis, view.up)) < 1e-9 * glm::length(axis)) {
      table.fail("up", "is along the view axis, expected another direction");
    }
  }
  table.finish();
  return view;
}

}  // namespace

std::vector<View> readViews(std::vector<SceneTable> tables) {
  std::vector<View> views;
  for (SceneTable& table : tables) {
    View view = readView(table);
    for (const View& other : views) {
      if (other.name == view.name) table.fail("name", "is taken by another view");
    }
    views.push_back(std::move(view));
  }
  return views;
}

}  // namespace glintmark
