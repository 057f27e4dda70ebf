// A view of a scene for Mitsuba 3, a renderer that shares nothing with this one.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/scene/scene.h"

namespace glintmark {

/// Writes scene.xml and what it names into `folder`, which exists: each material's triangles as
/// PLY, normal maps and pictures of lights as EXR, cones of light as caps of a far sphere, and
/// README.md. Returns what has no counterpart there, a sentence each. Throws Error naming a file
/// that cannot be written.
std::vector<std::string> exportMitsuba(const Scene& scene, const View& view, int width_px,
                                       int height_px, const std::filesystem::path& folder);

}  // namespace glintmark
