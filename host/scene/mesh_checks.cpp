#include "host/scene/mesh_checks.h"

#include <fmt/format.h>

#include <cmath>

#include "host/core/error.h"

namespace glintmark {
namespace {

template <typename Vector>
bool isFinite(const Vector& value) {
  for (int i = 0; i < Vector::length(); ++i) {
    if (!std::isfinite(value[i])) return false;
  }
  return true;
}

template <typename Vector>
void checkFinite(const std::vector<Vector>& values, const char* what, const std::string& source) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (isFinite(values[i])) continue;
    throw Error(fmt::format("{}: the {} of vertex {} is not finite", source, what, i));
  }
}

}  // namespace

void checkMesh(const TriangleMesh& mesh, const std::string& source) {
  if (mesh.triangles.empty()) {
    throw Error(fmt::format("{}: the mesh has no triangles, expected at least one", source));
  }
  const std::size_t vertex_count = mesh.positions.size();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.triangles[i][k] < vertex_count) continue;
      throw Error(fmt::format("{}: triangle {} names vertex {}, but there are only {} vertices",
                              source, i, mesh.triangles[i][k], vertex_count));
    }
  }
  checkFinite(mesh.positions, "position", source);
  checkFinite(mesh.normals, "normal", source);
  checkFinite(mesh.uvs, "uv", source);
}

}  // namespace glintmark
