#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host/scene/read_scene_parts.h"
#include "host/scene/scene_files.h"

namespace glintmark {
namespace {

constexpr int kPaintedSize_px = 256;
constexpr int kMaxTextureSize_px = 4096;
constexpr const char* kPolygonShape = "polygon";

std::vector<glm::dvec3> readRectangle(SceneTable& table) {
  const glm::dvec3 centre = table.vector3("centre", glm::dvec3(0));
  const glm::dvec3 normal = table.vector3("normal", glm::dvec3(0, -1, 0));
  if (glm::length(normal) == 0) table.fail("normal", "is 0, expected where the light faces");
  // Straight up, except where that is where the light faces.
  const bool lies = std::abs(glm::normalize(normal).y) > 0.99;
  const glm::dvec3 up = table.vector3("up", lies ? glm::dvec3(0, 0, -1) : glm::dvec3(0, 1, 0));
  if (!(glm::length(glm::cross(up, normal)) > 1e-6 * glm::length(up) * glm::length(normal)))
    table.fail("up", "is parallel to the normal, expected a direction across it");
  const glm::dvec2 size = table.vector2("size", glm::dvec2(1), kPositive);
  table.finish();
  return rectangleVertices(centre, normal, up, size);
}

std::vector<glm::dvec3> readOutline(SceneTable& table) {
  std::optional<SceneTable> rectangle = table.table("rectangle");
  const std::vector<glm::dvec3> vertices = table.colours("vertices", kFinite);
  if (rectangle && !vertices.empty())
    table.fail("vertices", "comes with a rectangle, expected one way or the other");
  if (!rectangle && !table.has("vertices"))
    table.fail("vertices", "is missing, expected 3 to 8 points, or else a rectangle");
  return rectangle ? readRectangle(*rectangle) : vertices;
}

// Beyond these a radius and its square do not go together in single precision.
constexpr Range kLightRadius{1e-12, 1e12};

double readRadius(SceneTable& table) {
  if (!table.has("radius")) table.fail("radius", "is missing, expected that of the light's shape");
  return table.number("radius", 1, kLightRadius);
}

void readEnds(SceneTable& table, AreaLight& light) {
  if (!table.has("ends")) table.fail("ends", "is missing, expected the 2 ends of the tube");
  const std::vector<glm::dvec3> ends = table.colours("ends", kFinite);
  if (ends.size() != 2)
    table.fail("ends", fmt::format("has {} points, expected the 2 ends of the tube", ends.size()));
  light.centre = ends[0];
  light.axis = ends[1] - ends[0];
  if (!(glm::length(light.axis) > 1e-6 * light.radius))
    table.fail("ends", "are in the same place, expected a tube that is longer than a disc");
}

// The keys of a light that is no polygon.
void readRoundShape(SceneTable& table, const std::string& name, AreaLight& light) {
  for (const char* key : {"vertices", "rectangle"})
    if (table.has(key))
      table.fail(key,
                 fmt::format("comes with the shape '{}', expected one way or the other", name));
  for (const char* key : {"texture", "image"})
    if (table.has(key))
      table.fail(key, fmt::format("comes with the shape '{}', expected a parallelogram for a light "
                                  "with a picture",
                                  name));
  light.radius = readRadius(table);
  if (name == "tube") {
    light.shape = LightShape::kTube;
    readEnds(table, light);
    return;
  }
  light.centre = table.vector3("centre", glm::dvec3(0));
  light.shape = LightShape::kSphere;
  if (name == "sphere") return;
  light.shape = LightShape::kDisc;
  const glm::dvec3 normal = table.vector3("normal", glm::dvec3(0, -1, 0));
  if (glm::length(normal) == 0) table.fail("normal", "is 0, expected where the disc faces");
  light.axis = glm::normalize(normal);
}

Image readTexture(SceneTable& table, const SceneRequest& request) {
  const std::string name = table.text("texture"), file = table.text("image");
  if (!name.empty() && !file.empty())
    table.fail("image", "comes with a texture, expected one way or the other");
  if (!name.empty()) {
    const std::vector<std::string> known = lightTextureNames();
    if (std::ranges::find(known, name) == known.end())
      table.fail("texture", fmt::format("is '{}', expected {}", name, fmt::join(known, ", ")));
    return paintLightTexture(name, kPaintedSize_px);
  }
  if (file.empty()) return {};
  const std::filesystem::path path = findSceneResource(file, table.file(), "light image");
  if (!request.image_loader)
    table.fail("image", "names an image, but this program reads no images; choose a texture");
  Image image = request.image_loader(path);
  if (image.channels < 3)
    table.fail("image",
               fmt::format("has {} channels, expected red, green and blue", image.channels));
  if (image.width < 1 || image.height < 1 ||
      std::max(image.width, image.height) > kMaxTextureSize_px)
    table.fail("image", fmt::format("has {} x {} pixels, expected 1 to {} each way", image.width,
                                    image.height, kMaxTextureSize_px));
  if (!std::ranges::all_of(image.pixels, [](float v) { return std::isfinite(v) && v >= 0; }))
    table.fail("image", "has pixels that are negative or not finite, expected radiance factors");
  return image;
}

AreaLight readAreaLight(SceneTable& table, const SceneRequest& request) {
  AreaLight light;
  light.name = table.text("name");
  light.radiance = table.vector3("radiance", glm::dvec3(1), kNotNegative);
  light.two_sided = table.flag("two_sided", false);
  const std::string shape = table.text("shape", kPolygonShape);
  if (shape == "disc" || shape == "sphere" || shape == "tube") {
    readRoundShape(table, shape, light);
    table.finish();
    return light;
  }
  if (shape != kPolygonShape)
    table.fail("shape", fmt::format("is '{}', expected polygon, disc, sphere, tube", shape));
  light.vertices = readOutline(table);
  const std::string complaint = areaLightComplaint(light);
  if (!complaint.empty()) table.fail("vertices", complaint);
  light.texture = readTexture(table, request);
  if (!light.texture.pixels.empty() && !isParallelogram(light))
    table.fail("vertices", "is no parallelogram, expected one for a light with a picture");
  table.finish();
  return light;
}

}  // namespace

std::vector<AreaLight> readAreaLights(SceneTable& root, const SceneRequest& request) {
  std::vector<AreaLight> lights;
  for (SceneTable& table : root.tables("area_light"))
    lights.push_back(readAreaLight(table, request));
  return lights;
}

}  // namespace glintmark
