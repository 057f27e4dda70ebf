// What a scene may ask of a mesh file.
#pragma once

namespace glintmark {

/// What triangles without uvs get: planar ones in a file that has some and box ones in a file that
/// has none, or always one of them.
enum class UvProjection { kAuto, kPlanar, kBox };

struct ImportOptions {
  UvProjection uv = UvProjection::kAuto;
  bool place_freely = false;     // may move and scale a mesh that floats hold badly where it is
  bool wants_materials = false;  // of the file, which only glTF has for now
};

}  // namespace glintmark
