// Reads scenes/*.toml and the meshes and images they name.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "host/core/image.h"
#include "host/scene/scene.h"

namespace glintmark {

struct SceneRequest {
  /// A name ("snow") looked up as <scene folder>/<name>.toml, or a path to a .toml file.
  std::string scene;
  /// `--set path.to.key=value` overrides, applied to the TOML before it is read, in order.
  std::vector<std::string> overrides;
  /// `--mesh FILE`: replaces the scene's mesh; empty for none.
  std::filesystem::path mesh_file;
  /// `--assets FOLDER`: searched for the file a scene lists under `mesh.asset`; empty for none.
  std::filesystem::path asset_folder;
  /// Reads the images that `environment.image` (at least three channels, linear rgb) and a normal
  /// map's `file` name. A scene that names one cannot be loaded without it.
  std::function<Image(const std::filesystem::path&)> image_loader{};
  /// Reads normal maps in its place, if there is one.
  std::function<Image(const std::filesystem::path&)> normal_loader{};
  /// The texels each way of such an image, by its head alone; for `before_maps`.
  std::function<glm::ivec2(const std::filesystem::path&)> normal_size{};
  /// Called before the scene's normal maps and its mesh are made: maps have a name and a size, 0x0
  /// if that is not known. What it throws ends the loading while nothing large has been made.
  std::function<void(const Scene&)> before_maps{};
  /// Reads a normal map that a mesh file holds, from its bytes; the name is for messages.
  std::function<Image(std::string_view bytes, const std::string& name)> image_decoder{};
};

/// Loads a scene. Throws Error with one sentence (file and line where there is one) for a missing
/// or malformed file, an unknown key (listing the known ones), a value out of range, a mesh without
/// uvs, NaN vertices or indices out of range.
Scene loadScene(const SceneRequest& request);

/// Names of all scenes in the scene folder, in alphabetical order.
std::vector<std::string> listScenes();

/// Folder of the scene files: $GLINTMARK_SCENES, else next to the executable, else the source tree.
std::filesystem::path sceneFolder();

}  // namespace glintmark
