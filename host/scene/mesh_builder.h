// Builds procedural meshes out of parametric patches.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>

#include "host/scene/part_mesh.h"

namespace glintmark {

struct SurfacePoint {
  glm::dvec3 position;
  glm::dvec2 uv{0, 0};
};

/// A surface over (s, t) in [0, 1]^2. Its front is the side that dP/ds x dP/dt points to.
using Surface = std::function<SurfacePoint(double s, double t)>;

enum class UvLayout {
  kFromSurface,  // the surface gives uv
  kArcLength,    // uv in scene units: lengths along the grid lines from the patch's middle lines,
                 // moved by whole units so that equal patches do not sparkle alike
};

class MeshBuilder {
 public:
  /// Index of the part of that name, new or known.
  std::uint32_t part(const std::string& name);

  /// Adds a grid of columns x rows quads (two triangles each). Normals come from differences of
  /// the surface itself, so that patches which meet smoothly also shade smoothly.
  void addPatch(std::uint32_t part_index, int columns, int rows, const Surface& surface,
                UvLayout layout = UvLayout::kFromSurface);

  /// As above, with the part of each quad chosen by (s, t) of its middle.
  void addPatch(const std::function<std::uint32_t(double s, double t)>& part_of, int columns,
                int rows, const Surface& surface, UvLayout layout = UvLayout::kFromSurface);

  /// The mesh so far; the builder is empty afterwards.
  PartMesh finish();

 private:
  void addVertices(int columns, int rows, const Surface& surface);
  void layOutByArcLength(std::size_t first, int columns, int rows);

  PartMesh built_;
  int arc_length_patches_ = 0;
};

}  // namespace glintmark
