// Flat polygon lights of a scene.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/core/image.h"

namespace glintmark {

/// A flat convex polygon that emits the same radiance in all directions.
struct AreaLight {
  std::string name;
  std::vector<glm::dvec3> vertices;  // 3 to 8, world space, counter-clockwise seen from the front
  glm::dvec3 radiance{1};
  bool two_sided = false;
  /// Factor on the radiance, linear rgb, row by row from the top; empty: 1 everywhere. Only
  /// parallelograms have one: its lower left corner is the first vertex, its lower right the
  /// second.
  Image texture;
};

/// What is wrong with the shape of a light, as the end of a sentence ("has 2 vertices, expected 3
/// to 8"), or empty: too few or too many vertices, values that are not finite, equal neighbours, no
/// area, not flat, not convex.
std::string areaLightComplaint(const AreaLight& light);

/// Unit normal of the front (right-hand rule) and area of a polygon that has no complaint.
glm::dvec3 areaLightNormal(const AreaLight& light);
double areaLightArea(const AreaLight& light);

/// Is the light a parallelogram, to a thousandth of its size?
bool isParallelogram(const AreaLight& light);

/// A rectangle around `centre` that faces along `normal`; `up` becomes the direction from the first
/// vertex to the last, as far as it is at right angles to the normal. `normal` and `up` must not be
/// parallel.
std::vector<glm::dvec3> rectangleVertices(const glm::dvec3& centre, const glm::dvec3& normal,
                                          const glm::dvec3& up, const glm::dvec2& size);

/// Distance from the polygon's plane, over its size, up to which it counts as flat.
inline constexpr double kFlatness = 1e-4;

/// Painted textures, linear rgb, `size_px` square: "checker", "stripes", "panes" (stained glass).
/// Throws Error for another name, listing these.
Image paintLightTexture(const std::string& name, int size_px);
std::vector<std::string> lightTextureNames();

}  // namespace glintmark
