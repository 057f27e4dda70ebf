#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <unordered_map>

#include "host/core/error.h"
#include "host/scene/generators.h"
#include "host/scene/import_mesh.h"
#include "host/scene/read_scene_parts.h"
#include "host/scene/scene_files.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

std::vector<MeshPlan::PartRule> readParts(std::optional<SceneTable> table,
                                          const std::vector<Material>& materials) {
  std::vector<MeshPlan::PartRule> rules;
  if (!table) return rules;
  std::unordered_map<std::string, std::uint32_t> numbers;
  for (const Material& material : materials)
    numbers.emplace(material.name, static_cast<std::uint32_t>(numbers.size()));
  for (const auto& [pattern, material_name] : table->textEntries()) {
    const auto found = numbers.find(material_name);
    if (found == numbers.end()) {
      std::vector<std::string> known;
      known.reserve(materials.size());
      for (const Material& material : materials) known.push_back(material.name);
      table->fail(pattern, fmt::format("is '{}', known materials are {}", material_name,
                                       fmt::join(known, ", ")));
    }
    rules.push_back({pattern, found->second});
  }
  return rules;
}

/// What [mesh] asks of any file.
ImportOptions readImportOptions(SceneTable& mesh, bool file_materials) {
  constexpr const char* kNames[] = {"auto", "planar", "box"};
  ImportOptions options;
  options.wants_materials = file_materials;
  const std::string name = mesh.text("uv", "auto");
  const auto found = std::ranges::find(kNames, name);
  if (found == std::end(kNames))
    mesh.fail("uv", fmt::format("is '{}', expected auto, planar or box", name));
  options.uv = static_cast<UvProjection>(found - std::begin(kNames));
  return options;
}

bool readFileMaterials(SceneTable& root) {
  const std::string from = root.text("materials", "scene");
  if (from != "scene" && from != "file")
    root.fail("materials", fmt::format("is '{}', expected scene or file", from));
  return from == "file";
}

void useFile(MeshPlan& plan, const fs::path& file, const ImportOptions& options) {
  plan.source = file.string();
  plan.build = [file, options] { return importMesh(file, options); };
}

/// What [mesh.asset] says: the real model that the generator stands in for.
struct Asset {
  std::string file_name;
  double uv_scale = 1;
  std::vector<MeshPlan::PartRule> rules;
  std::vector<View> views;
};

std::optional<Asset> readAsset(SceneTable& mesh, const std::vector<Material>& materials) {
  std::optional<SceneTable> table = mesh.table("asset");
  if (!table) return std::nullopt;
  Asset asset;
  asset.file_name = table->text("file");
  if (asset.file_name.empty()) table->fail("file", "is missing, expected the name of a mesh file");
  asset.uv_scale = table->number("uv_scale", 1, kPositive);
  asset.rules = readParts(table->table("parts"), materials);
  asset.views = readViews(table->tables("view"));
  table->finish();
  return asset;
}

void useAsset(MeshPlan& plan, const Asset& asset, const fs::path& file,
              const ImportOptions& options) {
  useFile(plan, file, options);
  plan.uv_scale = asset.uv_scale;
  plan.uv_offset = glm::dvec2(0);
  plan.rules = asset.rules;
  plan.own_views = asset.views;
}

}  // namespace

MeshPlan readMesh(SceneTable& root, const SceneRequest& request,
                  const std::vector<Material>& materials) {
  std::optional<SceneTable> mesh = root.table("mesh");
  if (!mesh) root.fail("mesh", "is missing, expected [mesh] with a generator or a file");
  MeshPlan plan;
  plan.uv_scale = mesh->number("uv_scale", 1, kPositive);
  plan.uv_offset = mesh->vector2("uv_offset", {0, 0}, kFinite);
  plan.rules = readParts(mesh->table("parts"), materials);
  const std::string file = mesh->text("file"), generator = mesh->text("generator");
  if (file.empty() && generator.empty()) {
    mesh->fail("generator", "is missing, expected a generator, or else a file");
  }
  if (!generator.empty()) {
    plan.source = "generator " + generator;
    plan.build = readGenerator(generator, *mesh);
  }
  const std::optional<Asset> asset = readAsset(*mesh, materials);
  plan.file_materials = readFileMaterials(root);
  ImportOptions options = readImportOptions(*mesh, plan.file_materials);
  mesh->finish();

  std::error_code error;
  if (!request.mesh_file.empty()) {
    if (!fs::exists(request.mesh_file, error)) {
      throw Error(
          fmt::format("no mesh file {}, expected a file that exists", request.mesh_file.string()));
    }
    if (asset && request.mesh_file.filename() == asset->file_name) {
      useAsset(plan, *asset, request.mesh_file, options);
    } else {
      options.place_freely = true;
      useFile(plan, request.mesh_file, options);
      plan.needs_fitted_views = true;
    }
    return plan;
  }
  if (asset && !request.asset_folder.empty()) {
    const fs::path asset_file = findAsset(request.asset_folder, asset->file_name);
    if (!asset_file.empty()) {
      useAsset(plan, *asset, asset_file, options);
      return plan;
    }
    plan.missing_asset = asset->file_name;
  }
  if (!file.empty()) useFile(plan, findSceneResource(file, mesh->file(), "mesh"), options);
  return plan;
}

}  // namespace glintmark
