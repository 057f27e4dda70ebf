#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_set>

#include "host/core/error.h"
#include "host/core/float4.h"
#include "host/scene/read_scene_parts.h"

namespace glintmark {
namespace {

// Below, squares of a microdetail's roughness are lost in single precision.
constexpr Range kMicroRoughness{1e-6, 1};
// Single precision holds lobes of no smaller slopes: their light goes missing, at 1e-8 a third.
constexpr Range kSurfaceRoughness{1e-6, 1};
constexpr Range kReflectance{0, 1};
constexpr Range kLogDensity{-12, 18};

float2 toFloat2(const glm::dvec2& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y)};
}

void readType(SceneTable& table, Material& material) {
  const std::string type = table.text("type", "glints");
  if (type != "glints" && type != "grooves" && type != "smooth") {
    table.fail("type", fmt::format("is '{}', expected glints, grooves or smooth", type));
  }
  material.has_glints = type != "smooth";
  material.has_grooves = type == "grooves";
}

void readNdf(SceneTable& table, Material& material) {
  const std::string ndf = table.text("ndf", "beckmann");
  if (ndf != "ggx" && ndf != "beckmann")
    table.fail("ndf", fmt::format("is '{}', expected ggx or beckmann", ndf));
  material.ggx = ndf == "ggx";
}

// The model that a key names; the first of all by default.
template <typename Model, std::size_t kCount>
Model readModel(SceneTable& table, const char* key, const NamedModel<Model> (&models)[kCount]) {
  const std::string name = table.text(key, models[0].name);
  std::string expected;
  for (std::size_t i = 0; i < kCount; ++i) {
    if (name == models[i].name) return models[i].model;
    expected += i == 0 ? "" : i + 1 < kCount ? ", " : " or ";
    expected += models[i].name;
  }
  table.fail(key, fmt::format("is '{}', expected {}", name, expected));
}

void readCompensation(SceneTable& table, Material& material) {
  material.compensation = readModel(table, "compensation", kCompensations);
  const float4& albedo = material.params.surface.albedo;
  if (material.compensation >= Compensation::kKullaConty &&
      std::max({albedo.x, albedo.y, albedo.z}) > 0)
    table.fail("compensation",
               fmt::format("'{}' is a lobe of its own, of metals: it needs albedo 0",
                           table.text("compensation", "")));
  if (material.compensation == Compensation::kSimulated && material.ggx)
    table.fail("compensation", "'simulated' is of Beckmann's facets, 'lobe' of ndf ggx too");
}

void readScattering(SceneTable& table, Material& material) {
  material.diffuse_model = readModel(table, "diffuse_model", kDiffuseModels);
  material.diffuse_roughness = table.number("diffuse_roughness", 0.5, kReflectance);
  material.diffuse_masking = table.number("diffuse_masking", 0, kReflectance);
  const bool has_lobes = material.diffuse_model == DiffuseModel::kPublished ||
                         material.diffuse_model == DiffuseModel::kRefit;
  if (material.diffuse_masking > 0 && !has_lobes)
    table.fail("diffuse_masking", "needs diffuse_model published or refit: others have no lobes");
  readCompensation(table, material);
}

void readPalette(SceneTable& table, Material& material) {
  if (!table.has("palette")) return;
  material.has_colour = material.has_glints;
  if (table.isText("palette")) {
    if (table.text("palette") != "wheel") {
      table.fail("palette", fmt::format("is '{}', expected \"wheel\" or a list of colours",
                                        table.text("palette")));
    }
    return;
  }
  const std::vector<glm::dvec3> colours = table.colours("palette", kReflectance);
  if (colours.empty() || colours.size() > GM_MAX_PALETTE) {
    table.fail("palette",
               fmt::format("has {} colours, expected 1 to {}", colours.size(), GM_MAX_PALETTE));
  }
  material.params.glints.palette_count = static_cast<uint>(colours.size());
  std::transform(colours.begin(), colours.end(), material.params.glints.palette,
                 [](const glm::dvec3& colour) { return toFloat4(colour); });
}

Material readMaterial(SceneTable& table, const SceneRequest& request, MapPlan& map) {
  Material material;
  material.name = table.text("name");
  readType(table, material);
  const glm::dvec2 alpha_g = table.vector2("global_roughness", glm::dvec2(0.3), kSurfaceRoughness);
  const glm::dvec2 micro = table.vector2("micro_roughness", glm::dvec2(0.1), kMicroRoughness);
  material.params.surface.alpha_g = toFloat2(alpha_g);
  material.params.glints.alpha_l = toFloat2(alpha_g * micro);
  material.params.glints.density =
      static_cast<float>(std::pow(10.0, table.number("log_density", 6, kLogDensity)));
  material.params.glints.size_variation =
      static_cast<float>(table.number("size_variation", 0, kNotNegative));
  material.params.surface.intensity =
      static_cast<float>(table.number("intensity", 1, kNotNegative));
  material.params.surface.f0 = toFloat4(table.vector3("f0", glm::dvec3(0.04), kReflectance));
  material.params.surface.albedo = toFloat4(table.vector3("albedo", glm::dvec3(0), kReflectance));
  readPalette(table, material);
  readNdf(table, material);
  readScattering(table, material);
  material.normal_map = readNormalMapSource(table, request, map);
  if (material.normal_map && material.has_glints)
    table.fail("normal_map", "is given, expected it for materials of type smooth only");
  table.finish();
  return material;
}

}  // namespace

std::vector<Material> readMaterials(SceneTable& root, const SceneRequest& request,
                                    std::vector<MapPlan>& maps) {
  std::vector<Material> materials;
  std::unordered_set<std::string> names;
  for (SceneTable& table : root.tables("material")) {
    MapPlan map{materials.size(), {}};
    Material material = readMaterial(table, request, map);
    if (material.name.empty()) table.fail("name", "is missing, expected the material's name");
    if (!names.insert(material.name).second) table.fail("name", "is taken by another material");
    materials.push_back(std::move(material));
    if (map.build) maps.push_back(std::move(map));
  }
  if (materials.empty()) root.fail("material", "is missing, expected at least one [[material]]");
  return materials;
}

}  // namespace glintmark
