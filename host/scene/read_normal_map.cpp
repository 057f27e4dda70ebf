// [material.normal_map]: a generated map or an image.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "host/core/error.h"
#include "host/filter/normal_map_generators.h"
#include "host/scene/read_scene_parts.h"
#include "host/scene/scene_files.h"

namespace glintmark {
namespace {

constexpr double kGeneratedHeightScale = 1;

// The position of `key`'s text among `names`, whose first is the default.
template <std::size_t kCount>
int choice(SceneTable& table, const char* key, const std::array<const char*, kCount>& names) {
  const std::string text = table.text(key, names.front());
  const auto found = std::ranges::find(names, text);
  if (found == names.end())
    table.fail(key, fmt::format("is '{}', expected {}", text, fmt::join(names, ", ")));
  return static_cast<int>(found - names.begin());
}

NormalMapRecipe readRecipe(SceneTable& table) {
  NormalMapRecipe recipe;
  recipe.kind = table.text("generator");
  recipe.size_px = table.integer("size_px", recipe.size_px, 1, kMaxNormalMapSize_px);
  recipe.seed = static_cast<std::uint32_t>(table.integer("seed", 1, 0, 1 << 30));
  const std::vector<std::string> known = normalMapGenerators();
  if (!recipe.kind.empty() && std::ranges::find(known, recipe.kind) == known.end())
    table.fail("generator",
               fmt::format("is '{}', expected {}", recipe.kind, fmt::join(known, ", ")));
  return recipe;
}

// A map of the file's name and size, without normals; `plan` reads them.
NormalMap planFile(const SceneTable& table, const std::string& file, const SceneRequest& request,
                   const NormalMapDecoding& decoding, MapPlan& plan) {
  const std::filesystem::path path = findSceneResource(file, table.file(), "normal map");
  const auto& loader = request.normal_loader ? request.normal_loader : request.image_loader;
  if (!loader)
    table.fail("file", "names an image, but this program reads no images; name a generator");
  plan.build = [path, loader, decoding] { return readNormalMap(path, loader, decoding); };
  glm::ivec2 size(0);
  if (request.before_maps && request.normal_size) size = request.normal_size(path);
  if (std::max(size.x, size.y) > kMaxNormalMapSize_px)
    table.fail("file", fmt::format("is {}, which has {}x{} texels, expected 1 to {} each way", file,
                                   size.x, size.y, kMaxNormalMapSize_px));
  return {path.filename().string(), size.x, size.y, {}};
}

NormalMap planGenerated(const NormalMapRecipe& recipe, MapPlan& plan) {
  plan.build = [recipe] { return generateNormalMap(recipe); };
  return {recipe.kind, recipe.size_px, recipe.size_px, {}};
}

}  // namespace

std::optional<NormalMapSource> readNormalMapSource(SceneTable& material,
                                                   const SceneRequest& request, MapPlan& plan) {
  std::optional<SceneTable> table = material.table("normal_map");
  if (!table) return std::nullopt;
  NormalMapRecipe recipe = readRecipe(*table);
  NormalMapDecoding decoding;
  decoding.content =
      static_cast<MapContent>(choice(*table, "content", std::array{"auto", "normals", "heights"}));
  decoding.green = static_cast<GreenAxis>(choice(*table, "green", std::array{"up", "down"}));
  const std::string file = table->text("file");
  if (file.empty() && recipe.kind.empty())
    table->fail("generator", "is missing, expected a generator, or else a file");
  decoding.height_scale = table->number("height_scale", decoding.height_scale);
  recipe.height_scale = table->number("height_scale", kGeneratedHeightScale);

  NormalMapSource source;
  source.lobes = table->integer("lobes", source.lobes, 1, kMaxLobes);
  table->finish();
  source.map = std::make_shared<const NormalMap>(
      file.empty() ? planGenerated(recipe, plan) : planFile(*table, file, request, decoding, plan));
  return source;
}

}  // namespace glintmark
