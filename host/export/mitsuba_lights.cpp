// Lights of a Mitsuba scene.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "host/export/mitsuba_parts.h"
#include "host/export/ply_file.h"
#include "host/report/picture/image_io.h"

namespace glintmark {
namespace {

// Lights at infinity are so many times as far as the scene is wide.
constexpr double kFar = 1000;
// Sides of a cap's rim: a polygon of so many has 0.04 % less area than the circle.
constexpr int kSides = 128;
constexpr double kRing_rad = 0.05;
// Between the sides of an area light, over its size.
constexpr double kApart = 1e-4;

void writeEmitter(MitsubaScene& to, const glm::dvec3& radiance) {
  to.xml.open("emitter", {{"type", "area"}});
  to.xml.leaf("rgb", {{"name", "radiance"}, {"value", rgbText(radiance, 1 / to.reflected_share)}});
  to.xml.close();
}

void writeBlackSurface(MitsubaScene& to) {
  to.xml.open("bsdf", {{"type", "diffuse"}});
  to.xml.leaf("rgb", {{"name", "reflectance"}, {"value", "0, 0, 0"}});
  to.xml.close();
}

// Light shapes reflect nothing.
void openLightShape(MitsubaScene& to, const PlyMesh& mesh, const std::string& name) {
  writePly(mesh, to.folder / name);
  to.xml.open("shape", {{"type", "ply"}});
  to.xml.leaf("string", {{"name", "filename"}, {"value", name}});
  to.xml.leaf("boolean", {{"name", "face_normals"}, {"value", "true"}});
  writeBlackSurface(to);
}

struct Bounds {
  glm::dvec3 centre;
  double radius;
};

// Of the meshes and the eye.
Bounds boundsOf(const Scene& scene, const View& view) {
  glm::dvec3 low = view.eye, high = view.eye;
  for (const glm::vec3& position : scene.mesh.positions) {
    low = glm::min(low, glm::dvec3(position));
    high = glm::max(high, glm::dvec3(position));
  }
  return {0.5 * (low + high), std::max(0.5 * glm::length(high - low), 1e-6)};
}

// The cap of a sphere around the scene that a cone of light cuts out, its front inwards.
PlyMesh capOf(const glm::dvec3& axis, double half_angle_rad, const Bounds& bounds) {
  const glm::dvec3 aside = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(aside, axis)), v = glm::cross(axis, u);
  const auto point = [&](double angle, int side) {
    const double turn = 2 * std::numbers::pi * side / kSides;
    const glm::dvec3 direction =
        std::cos(angle) * axis + std::sin(angle) * (std::cos(turn) * u + std::sin(turn) * v);
    return glm::vec3(bounds.centre + kFar * bounds.radius * direction);
  };
  const int rings = std::max(1, static_cast<int>(std::ceil(half_angle_rad / kRing_rad)));
  PlyMesh mesh;
  mesh.positions.push_back(point(0, 0));
  for (int ring = 1; ring <= rings; ++ring)
    for (int side = 0; side < kSides; ++side)
      mesh.positions.push_back(point(half_angle_rad * ring / rings, side));
  const auto index = [](int ring, int side) {
    return static_cast<std::uint32_t>(ring == 0 ? 0 : 1 + (ring - 1) * kSides + side % kSides);
  };
  for (int ring = 1; ring <= rings; ++ring)
    for (int side = 0; side < kSides; ++side) {
      mesh.triangles.push_back({index(ring - 1, side), index(ring, side + 1), index(ring, side)});
      if (ring > 1)
        mesh.triangles.push_back(
            {index(ring - 1, side), index(ring - 1, side + 1), index(ring, side + 1)});
    }
  return mesh;
}

void writeConeLight(MitsubaScene& to, const ConeLight& light, std::size_t number,
                    const Bounds& bounds) {
  const glm::dvec3 axis =
      glm::normalize(glm::dvec3(light.direction.x, light.direction.y, light.direction.z));
  const double half_angle_rad = light.direction.w;
  const glm::dvec3 irradiance(light.irradiance.x, light.irradiance.y, light.irradiance.z);
  if (half_angle_rad <= 0) {
    to.xml.open("emitter", {{"type", "directional"}});
    to.xml.leaf("vector", {{"name", "direction"}, {"value", rgbText(-axis)}});
    to.xml.leaf("rgb",
                {{"name", "irradiance"}, {"value", rgbText(irradiance, 1 / to.reflected_share)}});
    to.xml.close();
    return;
  }
  openLightShape(to, capOf(axis, half_angle_rad, bounds), fmt::format("cone_{}.ply", number));
  const double sine = std::sin(half_angle_rad);
  writeEmitter(to, irradiance / (std::numbers::pi * sine * sine));
  to.xml.close();
}

// A fan; the picture's rows run from the last vertex' side.
PlyMesh polygonOf(const AreaLight& light, bool back) {
  PlyMesh mesh;
  // Where two sides coincide, rays meet either.
  const glm::dvec3 apart =
      back ? -kApart * std::sqrt(areaLightArea(light)) * areaLightNormal(light) : glm::dvec3(0);
  for (const glm::dvec3& vertex : light.vertices) mesh.positions.emplace_back(vertex + apart);
  if (!light.texture.pixels.empty()) mesh.uvs = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  for (std::uint32_t i = 1; i + 1 < light.vertices.size(); ++i)
    mesh.triangles.push_back(back ? glm::uvec3(0, i + 1, i) : glm::uvec3(0, i, i + 1));
  return mesh;
}

void writePictureEmitter(MitsubaScene& to, const AreaLight& light, const std::string& name) {
  Image picture = light.texture;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    picture.pixels[i] *=
        static_cast<float>(light.radiance[static_cast<int>(i % 3)] / to.reflected_share);
  writeExr(picture, to.folder / name);
  to.xml.open("emitter", {{"type", "area"}});
  to.xml.open("texture", {{"name", "radiance"}, {"type", "bitmap"}});
  to.xml.leaf("string", {{"name", "filename"}, {"value", name}});
  to.xml.leaf("boolean", {{"name", "raw"}, {"value", "true"}});
  to.xml.leaf("string", {{"name", "wrap_mode"}, {"value", "clamp"}});
  to.xml.close();
  to.xml.close();
}

// A disc of Mitsuba's: the unit one about the origin, which faces +z, moved there.
void writeDisc(MitsubaScene& to, const glm::dvec3& centre, const glm::dvec3& normal, double radius,
               const glm::dvec3& radiance) {
  const glm::dvec3 n = glm::normalize(normal);
  const auto radii = lightRadii(n, radius);
  to.xml.open("shape", {{"type", "disk"}});
  to.xml.open("transform", {{"name", "to_world"}});
  std::string rows;
  for (int row = 0; row < 3; ++row)
    rows += fmt::format("{} {} {} {} ", radii[0][row], radii[1][row], radius * n[row], centre[row]);
  to.xml.leaf("matrix", {{"value", rows + "0 0 0 1"}});
  to.xml.close();
  writeBlackSurface(to);
  writeEmitter(to, radiance);
  to.xml.close();
}

// A sphere, or the side of a tube.
void writeCurvedSide(MitsubaScene& to, const AreaLight& light, bool inside) {
  const bool tube = light.shape == LightShape::kTube;
  to.xml.open("shape", {{"type", tube ? "cylinder" : "sphere"}});
  to.xml.leaf("boolean", {{"name", "flip_normals"}, {"value", inside ? "true" : "false"}});
  to.xml.leaf("float", {{"name", "radius"}, {"value", fmt::format("{}", light.radius)}});
  const auto point = [&](const char* name, const glm::dvec3& p) {
    to.xml.leaf("point", {{"name", name},
                          {"x", fmt::format("{}", p.x)},
                          {"y", fmt::format("{}", p.y)},
                          {"z", fmt::format("{}", p.z)}});
  };
  if (tube) {
    point("p0", light.centre);
    point("p1", light.centre + light.axis);
  } else {
    point("center", light.centre);
  }
  writeBlackSurface(to);
  writeEmitter(to, light.radiance);
  to.xml.close();
}

// The inside is one more shape, a little smaller, so that a ray meets the side that it comes from.
void writeRoundLight(MitsubaScene& to, const AreaLight& light) {
  for (const bool back : {false, true}) {
    if (back && !light.two_sided) continue;
    const glm::dvec3 axis = light.axis;
    const double apart = back ? kApart * light.radius : 0.0;
    if (light.shape == LightShape::kDisc) {
      writeDisc(to, light.centre - apart * axis, back ? -axis : axis, light.radius, light.radiance);
      continue;
    }
    AreaLight side = light;
    side.radius -= apart;
    writeCurvedSide(to, side, back);
    if (light.shape == LightShape::kSphere) continue;
    const glm::dvec3 inwards = apart * glm::normalize(axis);
    writeDisc(to, light.centre + inwards, back ? axis : -axis, side.radius, light.radiance);
    writeDisc(to, light.centre + axis - inwards, back ? -axis : axis, side.radius, light.radiance);
  }
}

void writeAreaLight(MitsubaScene& to, const AreaLight& light, std::size_t number) {
  if (light.shape != LightShape::kPolygon) {
    writeRoundLight(to, light);
    return;
  }
  for (const bool back : {false, true}) {
    if (back && !light.two_sided) continue;
    openLightShape(to, polygonOf(light, back),
                   fmt::format("light_{}{}.ply", number, back ? "_back" : ""));
    if (light.texture.pixels.empty())
      writeEmitter(to, light.radiance);
    else
      writePictureEmitter(to, light, fmt::format("picture_{}.exr", number));
    to.xml.close();
  }
}

}  // namespace

void writeLights(MitsubaScene& to) {
  const Bounds bounds = boundsOf(to.scene, to.view);
  for (std::size_t i = 0; i < to.scene.lights.size(); ++i)
    writeConeLight(to, to.scene.lights[i], i, bounds);
  for (std::size_t i = 0; i < to.scene.area_lights.size(); ++i)
    writeAreaLight(to, to.scene.area_lights[i], i);
  const bool cones = std::ranges::any_of(
      to.scene.lights, [](const ConeLight& light) { return light.direction.w > 0; });
  if (cones)
    to.notes.push_back(fmt::format(
        "cones of light are {}-sided caps of a sphere {} times as wide as the scene, here they are "
        "round and at infinity",
        kSides, kFar));
  if (!to.scene.area_lights.empty())
    to.notes.emplace_back("area lights hide what is behind them, here they hide nothing");
}

}  // namespace glintmark
