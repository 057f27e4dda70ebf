#include "host/experiment/run_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/fnv1a.h"
#include "host/core/output_files.h"
#include "host/fit/data_folder.h"
#include "host/ocl/compute.h"
#include "host/scene/load_scene.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

// Of every regular file below a folder, or of one file, in the order of their names.
std::string hashOf(const fs::path& path, FileRole role = FileRole::kInput) {
  std::error_code error;
  std::vector<fs::path> files;
  if (fs::is_directory(path, error)) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path, error))
      if (entry.is_regular_file(error)) files.push_back(entry.path());
  } else {
    files.push_back(path);
  }
  std::ranges::sort(files);
  std::string hashes;
  for (const fs::path& file : files) {
    try {
      hashes += fmt::format("{} {:016x}\n", file.lexically_relative(path).string(),
                            fnv1a(readFile(file, role)));
    } catch (const OverwriteError&) {
      throw;
    } catch (const Error&) {
      hashes += "unreadable\n";
    }
  }
  return hashes;
}

}  // namespace

std::string hashInputs(const CommonOptions& common, const std::vector<std::string>& scenes) {
  // What is read of these folders says so itself; outputs may lie beside it.
  std::string hashes =
      hashOf(kernelFolder(), FileRole::kOwn) + hashOf(sceneFolder(), FileRole::kOwn);
  try {
    hashes += hashOf(findDataFile("multiscatter.json").parent_path(), FileRole::kOwn);
  } catch (const Error&) {
    hashes += "no tables\n";
  }
  for (const std::string& scene : scenes)
    if (fs::path(scene).extension() == ".toml") hashes += hashOf(scene);
  if (!common.mesh_file.empty()) hashes += hashOf(common.mesh_file);
  if (!common.asset_folder.empty()) hashes += hashOf(common.asset_folder, FileRole::kOwn);
  return fmt::format("{:016x}", fnv1a(hashes));
}

}  // namespace glintmark
