// The readers of a scene file's sections. Each throws Error with the place in the file.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/scene/load_scene.h"
#include "host/scene/part_mesh.h"
#include "host/scene/scene_table.h"

namespace glintmark {

/// Where a material's normal map comes from, checked but not yet made.
struct MapPlan {
  std::size_t material = 0;  // its number in the scene
  std::function<NormalMap()> build;
};

/// [[material]]; at least one. Their normal maps come from `maps`.
std::vector<Material> readMaterials(SceneTable& root, const SceneRequest& request,
                                    std::vector<MapPlan>& maps);

/// [material.normal_map], if the material has one: its source with the map's name and size, and
/// what generates or loads the map.
std::optional<NormalMapSource> readNormalMapSource(SceneTable& material,
                                                   const SceneRequest& request, MapPlan& plan);

/// [[light]].
std::vector<ConeLight> readLights(SceneTable& root);

/// [[area_light]].
std::vector<AreaLight> readAreaLights(SceneTable& root, const SceneRequest& request);

/// [environment], appended to `lights` as cones.
EnvironmentInfo readEnvironment(SceneTable& root, const SceneRequest& request,
                                std::vector<ConeLight>& lights);

/// A list of views from [[view]] tables; names must differ.
std::vector<View> readViews(std::vector<SceneTable> tables);

/// Unit vector at an azimuth around y (0 is +z, 90 is +x) and an elevation above the horizon.
glm::dvec3 directionFromAngles(double azimuth_deg, double elevation_deg);

/// Where the mesh comes from, checked but not yet built.
struct MeshPlan {
  struct PartRule {
    std::string pattern;  // a part's name, or the start of one and '*'
    std::uint32_t material = 0;
  };
  std::function<PartMesh()> build;
  std::string source;           // for messages: a file, or "generator car"
  double uv_scale = 1;          // uv units per uv unit of the source
  glm::dvec2 uv_offset{0, 0};   // added after that [uv]
  std::vector<PartRule> rules;  // the closest match counts; no match: material 0
  std::vector<View> own_views;  // of the asset: they replace the scene's views of the same names
  std::string missing_asset;    // looked for in the asset folder and not found
  bool file_materials = false;  // the file's own, except of parts that a rule names
  bool needs_fitted_views = false;  // a stranger's mesh: the scene's cameras mean nothing
};

/// [mesh].
MeshPlan readMesh(SceneTable& root, const SceneRequest& request,
                  const std::vector<Material>& materials);

/// The TOML of a scene file. Throws Error with the line of what is malformed.
toml::table parseSceneText(std::string_view text, const std::string& file);

/// A scene that lacks its mesh and its normal maps, and where those come from.
struct PlannedScene {
  Scene scene;
  MeshPlan plan;
  std::vector<MapPlan> maps;
};

/// Everything of a scene file but making its mesh and its normal maps; changes `content` by the
/// request's overrides.
PlannedScene planScene(toml::table& content, const std::string& file, const SceneRequest& request);

}  // namespace glintmark
