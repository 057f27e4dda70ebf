#include <cmath>

#include "host/core/error.h"
#include "host/core/float4.h"
#include "host/scene/environment.h"
#include "host/scene/read_scene_parts.h"
#include "host/scene/scene_files.h"

namespace glintmark {
namespace {

constexpr Range kAzimuth{-360, 360};
constexpr Range kElevation{-90, 90};
constexpr Range kHalfAngle{0, 90};

ConeLight readLight(SceneTable& table) {
  table.text("name");
  glm::dvec3 direction = table.vector3("direction", glm::dvec3(0));
  const double azimuth_deg = table.number("azimuth_deg", 0, kAzimuth);
  const double elevation_deg = table.number("elevation_deg", 45, kElevation);
  if (!table.has("direction")) {
    direction = directionFromAngles(azimuth_deg, elevation_deg);
  } else if (table.has("azimuth_deg") || table.has("elevation_deg")) {
    table.fail("direction",
               "comes with azimuth_deg or elevation_deg, expected one way or the other");
  } else if (glm::length(direction) == 0) {
    table.fail("direction", "is 0, expected a vector towards the light");
  }
  direction = glm::normalize(direction);
  const double half_angle_rad = glm::radians(table.number("half_angle_deg", 0.27, kHalfAngle));
  const glm::dvec3 irradiance = table.vector3("irradiance", glm::dvec3(1), kNotNegative);
  table.finish();
  return {toFloat4(direction, half_angle_rad), toFloat4(irradiance)};
}

SkyParameters readSky(SceneTable& table) {
  SkyParameters sky;
  sky.zenith = table.vector3("zenith", sky.zenith, kNotNegative);
  sky.horizon = table.vector3("horizon", sky.horizon, kNotNegative);
  sky.ground = table.vector3("ground", sky.ground, kNotNegative);
  for (SceneTable& lamp_table : table.tables("lamp")) {
    SkyParameters::Lamp lamp;
    lamp_table.text("name");
    lamp.direction = directionFromAngles(lamp_table.number("azimuth_deg", 0, kAzimuth),
                                         lamp_table.number("elevation_deg", 45, kElevation));
    lamp.half_angle_rad = glm::radians(lamp_table.number("half_angle_deg", 5, {1, 90}));
    lamp.radiance = lamp_table.vector3("radiance", glm::dvec3(10), kNotNegative);
    lamp_table.finish();
    sky.lamps.push_back(lamp);
  }
  return sky;
}

}  // namespace

glm::dvec3 directionFromAngles(double azimuth_deg, double elevation_deg) {
  const double azimuth = glm::radians(azimuth_deg), elevation = glm::radians(elevation_deg);
  return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
          std::cos(elevation) * std::cos(azimuth)};
}

std::vector<ConeLight> readLights(SceneTable& root) {
  std::vector<ConeLight> lights;
  for (SceneTable& table : root.tables("light")) lights.push_back(readLight(table));
  return lights;
}

EnvironmentInfo readEnvironment(SceneTable& root, const SceneRequest& request,
                                std::vector<ConeLight>& lights) {
  EnvironmentInfo info;
  std::optional<SceneTable> table = root.table("environment");
  if (!table) return info;
  EnvironmentCut cut;
  cut.cone_count = table->integer("cones", 8, 1, 256);
  cut.scale = table->number("scale", 1, kNotNegative);
  cut.rotation_rad = glm::radians(table->number("rotation_deg", 0, kAzimuth));
  info.file = table->text("image");
  const SkyParameters sky = readSky(*table);
  table->finish();

  Image map;
  if (info.file.empty()) {
    map = renderSky(sky);
  } else {
    const std::filesystem::path file =
        findSceneResource(info.file, table->file(), "environment image");
    if (!request.image_loader) {
      table->fail("image", "names an image, but this program reads no images; remove it for a sky");
    }
    map = request.image_loader(file);
    info.note = clampTinyNegatives(map);
    info.file = file.string();
  }
  const std::vector<ConeLight> cones = cutEnvironment(map, cut);
  lights.insert(lights.end(), cones.begin(), cones.end());
  info.present = true;
  info.map = std::make_shared<const Image>(std::move(map));
  info.cut = cut;
  info.cone_count = static_cast<int>(cones.size());
  return info;
}

}  // namespace glintmark
