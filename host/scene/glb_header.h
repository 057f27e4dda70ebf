// What the chunk headers of a binary glTF file promise.
#pragma once
#include <filesystem>

namespace glintmark {

/// Throws Error if a chunk of a GLB file is longer than the file. The importer allocates whatever
/// length it finds, up to 4 GB. [Khronos, glTF 2.0, "GLB File Format"]
void checkGlbSize(const std::filesystem::path& file);

}  // namespace glintmark
