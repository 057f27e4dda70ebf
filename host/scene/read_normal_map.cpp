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

NormalMap loadFile(const SceneTable& table, const std::string& file, const SceneRequest& request,
                   const NormalMapDecoding& decoding) {
  const std::filesystem::path path = findSceneResource(file, table.file(), "normal map");
  const auto& loader = request.normal_loader ? request.normal_loader : request.image_loader;
  if (!loader)
    table.fail("file", "names an image, but this program reads no images; name a generator");
  return readNormalMap(path, loader, decoding);
}

}  // namespace

std::optional<NormalMapSource> readNormalMapSource(SceneTable& material,
                                                   const SceneRequest& request) {
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
      file.empty() ? generateNormalMap(recipe) : loadFile(*table, file, request, decoding));
  return source;
}

}  // namespace glintmark
