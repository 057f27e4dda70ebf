// What the header of a PLY file promises.
#pragma once
#include <filesystem>

namespace glintmark {

/// Throws Error if a PLY file has no whole header or is too short for the elements that the header
/// counts. The importer reads on for ever in such a file. [Turk, "The PLY Polygon File Format",
/// 1994]
void checkPlySize(const std::filesystem::path& file);

}  // namespace glintmark
