// Where scenes and the files they name are found.
#pragma once
#include <filesystem>
#include <string>

namespace glintmark {

/// The .toml file of a scene: a path if it ends in .toml, else a name in sceneFolder(). Throws
/// Error for one that does not exist, listing the known scenes.
std::filesystem::path findSceneFile(const std::string& scene);

/// A file that a scene names: absolute, or relative to the scene file, or else to the current
/// folder. Throws Error if it is in neither; `what` says what it is for.
std::filesystem::path findSceneResource(const std::filesystem::path& file,
                                        const std::filesystem::path& scene_file,
                                        const std::string& what);

/// The file called `name` in `folder` or one of its direct subfolders, the alphabetically first;
/// empty if there is none. Throws Error if `folder` is no folder.
std::filesystem::path findAsset(const std::filesystem::path& folder, const std::string& name);

}  // namespace glintmark
