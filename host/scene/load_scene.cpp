#include "host/scene/load_scene.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/scene/file_materials.h"
#include "host/scene/fit_views.h"
#include "host/scene/mesh_checks.h"
#include "host/scene/mesh_frames.h"
#include "host/scene/overrides.h"
#include "host/scene/read_scene_parts.h"
#include "host/scene/scene_files.h"
#include "host/scene/toml_depth.h"

namespace glintmark {
namespace {

/// Material of a part by the rule that fits its name most closely: the name itself, else the
/// longest start of it; `fallback` if none does.
std::uint32_t materialOf(const std::string& part, const std::vector<MeshPlan::PartRule>& rules,
                         std::uint32_t fallback) {
  std::uint32_t material = fallback;
  std::size_t best = 0;
  for (const MeshPlan::PartRule& rule : rules) {
    if (rule.pattern == part) return rule.material;
    if (!rule.pattern.ends_with('*') || rule.pattern.size() <= best) continue;
    if (!part.starts_with(rule.pattern.substr(0, rule.pattern.size() - 1))) continue;
    material = rule.material;
    best = rule.pattern.size();
  }
  return material;
}

void buildMesh(const MeshPlan& plan, const SceneRequest& request, Scene& scene) {
  PartMesh built = plan.build();
  const auto first_of_file = static_cast<std::uint32_t>(scene.materials.size());
  if (plan.file_materials) {
    if (built.materials.empty())
      built.notes.push_back(
          fmt::format("{} brings no materials, so the scene's are used", plan.source));
    for (Material& material : toMaterials(built.materials, request, built.notes))
      scene.materials.push_back(std::move(material));
  }
  std::vector<std::uint32_t> material_of_part;
  for (std::uint32_t i = 0; i < built.parts.size(); ++i) {
    const bool has_own = plan.file_materials && i < built.materials.size();
    material_of_part.push_back(
        materialOf(built.parts[i], plan.rules, has_own ? first_of_file + i : 0));
  }
  for (std::uint32_t& index : built.mesh.triangle_materials) index = material_of_part[index];
  for (glm::dvec2& uv : built.mesh.uvs) uv = uv * plan.uv_scale + plan.uv_offset;
  checkMesh(built.mesh, plan.source);
  computeTangents(built.mesh);
  scene.mesh = std::move(built.mesh);
  scene.notes.insert(scene.notes.end(), built.notes.begin(), built.notes.end());
}

/// The asset's views replace those of the same names and join the others.
void replaceViews(const std::vector<View>& own_views, std::vector<View>& views) {
  for (const View& own : own_views) {
    const auto same =
        std::find_if(views.begin(), views.end(), [&](const View& v) { return v.name == own.name; });
    if (same != views.end()) {
      *same = own;
    } else {
      views.push_back(own);
    }
  }
}

/// Microdetails are drawn under polygons; under other area lights nothing counts them.
void requirePolygonsForGlints(SceneTable& root, const Scene& scene) {
  const auto glints = std::ranges::find_if(scene.materials, &Material::has_glints);
  const auto round = std::ranges::find_if(
      scene.area_lights, [](const AreaLight& l) { return l.shape != LightShape::kPolygon; });
  if (glints == scene.materials.end() || round == scene.area_lights.end()) return;
  root.fail(
      "area_light",
      fmt::format("has a disc, sphere or tube ('{}'), but material '{}' has glints, which are "
                  "drawn under polygons only; expected vertices or a rectangle",
                  round->name, glints->name));
}

void readPost(SceneTable& root, PostEffects& post) {
  std::optional<SceneTable> table = root.table("post");
  if (!table) return;
  post.star = table->flag("star", post.star);
  post.exposure = table->number("exposure", post.exposure, kPositive);
  table->finish();
}

}  // namespace

toml::table parseSceneText(std::string_view text, const std::string& file) {
  checkTomlDepth(text, file);
  try {
    return toml::parse(text, file);
  } catch (const toml::parse_error& error) {
    throw Error(fmt::format("{}:{}: malformed TOML: {}", file, error.source().begin.line,
                            error.description()));
  }
}

PlannedScene planScene(toml::table& content, const std::string& file, const SceneRequest& request) {
  for (const std::string& text : request.overrides) applyOverride(content, text, file);

  SceneTable root(content, "", file);
  Scene scene;
  scene.name = std::filesystem::path(file).stem().string();
  scene.description = root.text("description");
  scene.cull_back_faces = root.flag("cull_back_faces", false);
  std::vector<MapPlan> maps;
  scene.materials = readMaterials(root, request, maps);
  scene.views = readViews(root.tables("view"));
  if (scene.views.empty()) root.fail("view", "is missing, expected at least one [[view]]");
  scene.lights = readLights(root);
  scene.area_lights = readAreaLights(root, request);
  requirePolygonsForGlints(root, scene);
  readPost(root, scene.post);
  MeshPlan plan = readMesh(root, request, scene.materials);
  scene.environment = readEnvironment(root, request, scene.lights);
  for (const Material& material : scene.materials)
    if (material.params.surface.intensity > 1)
      scene.notes.push_back(
          fmt::format("material '{}' has an intensity of {:g}: its specular lobe "
                      "returns more light than it gets where f0 times that is "
                      "above 1",
                      material.name, material.params.surface.intensity));
  if (!scene.environment.note.empty()) scene.notes.push_back(scene.environment.note);
  root.finish();
  if (scene.lights.empty() && scene.area_lights.empty()) {
    root.fail("light",
              "is missing, expected at least one [[light]], [[area_light]] or [environment]");
  }
  return {std::move(scene), std::move(plan), std::move(maps)};
}

Scene loadScene(const SceneRequest& request) {
  const std::string file = findSceneFile(request.scene).string();
  toml::table content = parseSceneText(readFile(file), file);
  PlannedScene planned = planScene(content, file, request);
  const MeshPlan& plan = planned.plan;
  Scene& scene = planned.scene;

  if (request.before_maps) request.before_maps(scene);
  for (const MapPlan& map : planned.maps)
    scene.materials[map.material].normal_map->map = std::make_shared<const NormalMap>(map.build());
  buildMesh(plan, request, scene);
  replaceViews(plan.own_views, scene.views);
  if (plan.needs_fitted_views) {
    fitViews(scene.mesh, scene.views);
    scene.notes.push_back(fmt::format("the views were fitted to {}", plan.source));
  }
  if (!plan.missing_asset.empty()) {
    scene.notes.push_back(fmt::format("{} is not in {}, so the procedural mesh stands in",
                                      plan.missing_asset, request.asset_folder.string()));
  }
  return std::move(planned.scene);
}

}  // namespace glintmark
