// Where precomputed data is found.
#pragma once
#include <filesystem>
#include <string>

namespace glintmark {

/// The file called `name` of the data folder: that of the environment variable GLINTMARK_TABLES,
/// else share/glintmark/data or data next to the executable, else the source tree's. Throws Error
/// if it is not there.
std::filesystem::path findDataFile(const std::string& name);

}  // namespace glintmark
