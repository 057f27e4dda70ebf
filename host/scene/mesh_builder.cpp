#include "host/scene/mesh_builder.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace glintmark {
namespace {

// Step of the differences that give normals, in parameter space: small against any fold, large
// against the rounding of doubles.
constexpr double kDifferenceStep = 1e-4;
// How far towards the patch's middle a pole steps aside to find a normal.
constexpr double kPoleStep = 1e-2;

/// dP/ds x dP/dt, not normalised; one-sided at the patch's borders.
glm::dvec3 crossOfDerivatives(const Surface& surface, double s, double t) {
  const double s0 = std::max(s - kDifferenceStep, 0.0), s1 = std::min(s + kDifferenceStep, 1.0);
  const double t0 = std::max(t - kDifferenceStep, 0.0), t1 = std::min(t + kDifferenceStep, 1.0);
  return glm::cross((surface(s1, t).position - surface(s0, t).position) / (s1 - s0),
                    (surface(s, t1).position - surface(s, t0).position) / (t1 - t0));
}

glm::dvec3 normalOf(const Surface& surface, double s, double t) {
  glm::dvec3 normal = crossOfDerivatives(surface, s, t);
  if (glm::length(normal) < 1e-9) {
    normal = crossOfDerivatives(surface, glm::mix(s, 0.5, kPoleStep), glm::mix(t, 0.5, kPoleStep));
  }
  const double length = glm::length(normal);
  return length > 0 ? normal / length : glm::dvec3(0, 1, 0);
}

}  // namespace

std::uint32_t MeshBuilder::part(const std::string& name) {
  const auto found = std::find(built_.parts.begin(), built_.parts.end(), name);
  if (found == built_.parts.end()) {
    built_.parts.push_back(name);
    return static_cast<std::uint32_t>(built_.parts.size() - 1);
  }
  return static_cast<std::uint32_t>(found - built_.parts.begin());
}

void MeshBuilder::addPatch(std::uint32_t part_index, int columns, int rows, const Surface& surface,
                           UvLayout layout) {
  addPatch([part_index](double, double) { return part_index; }, columns, rows, surface, layout);
}

void MeshBuilder::addPatch(const std::function<std::uint32_t(double s, double t)>& part_of,
                           int columns, int rows, const Surface& surface, UvLayout layout) {
  TriangleMesh& mesh = built_.mesh;
  const std::size_t first = mesh.positions.size();
  addVertices(columns, rows, surface);
  if (layout == UvLayout::kArcLength) layOutByArcLength(first, columns, rows);

  const auto index = [&](int i, int j) {
    return static_cast<std::uint32_t>(first + static_cast<std::size_t>(j) * (columns + 1) + i);
  };
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.triangles.emplace_back(index(i, j), index(i + 1, j), index(i + 1, j + 1));
      mesh.triangles.emplace_back(index(i, j), index(i + 1, j + 1), index(i, j + 1));
      const std::uint32_t quad_part = part_of((i + 0.5) / columns, (j + 0.5) / rows);
      mesh.triangle_materials.insert(mesh.triangle_materials.end(), 2, quad_part);
    }
  }
}

void MeshBuilder::addVertices(int columns, int rows, const Surface& surface) {
  TriangleMesh& mesh = built_.mesh;
  const std::size_t first = mesh.positions.size();
  const std::size_t count = static_cast<std::size_t>(columns + 1) * (rows + 1);
  mesh.positions.resize(first + count);
  mesh.normals.resize(first + count);
  mesh.uvs.resize(first + count);
  tbb::parallel_for(0, rows + 1, [&](int j) {
    for (int i = 0; i <= columns; ++i) {
      const double s = static_cast<double>(i) / columns, t = static_cast<double>(j) / rows;
      const std::size_t vertex = first + static_cast<std::size_t>(j) * (columns + 1) + i;
      const SurfacePoint point = surface(s, t);
      mesh.positions[vertex] = point.position;
      mesh.uvs[vertex] = point.uv;
      mesh.normals[vertex] = normalOf(surface, s, t);
    }
  });
}

namespace {

/// Whole uv units by which patch number `patch` is moved; small, so that uvs stay precise.
glm::dvec2 chartOffset(int patch) {
  return {(patch * 37) % 101, (patch * 53) % 103};
}

}  // namespace

void MeshBuilder::layOutByArcLength(std::size_t first, int columns, int rows) {
  TriangleMesh& mesh = built_.mesh;
  const auto at = [&](int i, int j) {
    return first + static_cast<std::size_t>(j) * (columns + 1) + i;
  };
  const auto distance = [&](std::size_t a, std::size_t b) {
    return static_cast<double>(glm::distance(mesh.positions[a], mesh.positions[b]));
  };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.uvs[at(i, j)].x =
          i == 0 ? 0 : mesh.uvs[at(i - 1, j)].x + distance(at(i - 1, j), at(i, j));
      mesh.uvs[at(i, j)].y =
          j == 0 ? 0 : mesh.uvs[at(i, j - 1)].y + distance(at(i, j - 1), at(i, j));
    }
  }
  const glm::dvec2 offset = chartOffset(arc_length_patches_++);
  // Each line starts at the middle of the patch: the shear that unequal lines bring is halved.
  for (int j = 0; j <= rows; ++j) {
    const double middle = mesh.uvs[at(columns / 2, j)].x - offset.x;
    for (int i = 0; i <= columns; ++i) mesh.uvs[at(i, j)].x -= middle;
  }
  for (int i = 0; i <= columns; ++i) {
    const double middle = mesh.uvs[at(i, rows / 2)].y - offset.y;
    for (int j = 0; j <= rows; ++j) mesh.uvs[at(i, j)].y -= middle;
  }
}

PartMesh MeshBuilder::finish() {
  PartMesh result = std::move(built_);
  *this = {};
  return result;
}

}  // namespace glintmark
