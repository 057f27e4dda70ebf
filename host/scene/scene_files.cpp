#include "host/scene/scene_files.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "host/core/error.h"
#include "host/core/unknown_name.h"
#include "host/scene/load_scene.h"

namespace glintmark {
namespace fs = std::filesystem;

fs::path sceneFolder() {
  if (const char* folder = std::getenv("GLINTMARK_SCENES"); folder != nullptr && *folder != '\0') {
    return folder;
  }
  std::error_code error;
  const fs::path executable = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    const fs::path beside = executable.parent_path();
    for (const fs::path& folder : {beside / "../share/glintmark/scenes", beside / "scenes"}) {
      if (fs::is_directory(folder, error)) return folder.lexically_normal();
    }
  }
  return GLINTMARK_SCENE_SOURCE_DIR;
}

std::vector<std::string> listScenes() {
  std::vector<std::string> names;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(sceneFolder(), error)) {
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

fs::path findSceneFile(const std::string& scene) {
  std::error_code error;
  fs::path path(scene);
  if (path.extension() == ".toml") {
    if (fs::is_regular_file(path, error)) return path;
    throw Error(fmt::format("no scene file {}, expected a .toml file that exists", scene));
  }
  fs::path file = sceneFolder() / (scene + ".toml");
  if (!scene.empty() && !path.has_parent_path() && fs::is_regular_file(file, error)) return file;
  throw Error(unknownName("scene", scene, listScenes(), "scenes in " + sceneFolder().string()));
}

fs::path findSceneResource(const fs::path& file, const fs::path& scene_file,
                           const std::string& what) {
  std::error_code error;
  const std::string text = file.string();
  const std::size_t layer = text.rfind('#');
  for (const fs::path& candidate : {scene_file.parent_path() / file, file}) {
    if (fs::exists(candidate, error)) return candidate;
    if (layer == std::string::npos) continue;
    // A layer of a file is named after it.
    const std::string whole = candidate.string();
    if (fs::exists(whole.substr(0, whole.rfind('#')), error)) return candidate;
  }
  throw Error(fmt::format("no {} file {}, expected a file that exists, beside {} or from here",
                          what, file.string(), scene_file.string()));
}

fs::path findAsset(const fs::path& folder, const std::string& name) {
  std::error_code error;
  if (!fs::is_directory(folder, error)) {
    throw Error(fmt::format("no asset folder {}, expected a folder that exists", folder.string()));
  }
  std::vector<fs::path> candidates = {folder / name};
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.is_directory(error)) candidates.push_back(entry.path() / name);
  }
  std::sort(candidates.begin() + 1, candidates.end());
  for (const fs::path& candidate : candidates) {
    if (fs::is_regular_file(candidate, error)) return candidate;
  }
  return {};
}

}  // namespace glintmark
