// Area lights of a scene: flat polygons, discs, spheres and tubes.
#pragma once
#include <array>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/core/image.h"

namespace glintmark {

enum class LightShape {
  kPolygon,  // flat and convex
  kDisc,
  kSphere,
  kTube  // a cylinder closed by a disc at either end
};

/// A light that emits the same radiance in all directions.
struct AreaLight {
  std::string name;
  LightShape shape = LightShape::kPolygon;
  /// Of a polygon: 3 to 8, world space, counter-clockwise seen from the front.
  std::vector<glm::dvec3> vertices;
  glm::dvec3 radiance{1};
  bool two_sided = false;  // the back emits too, of spheres and tubes the inside
  /// Of the other shapes, world space: the centre of a disc or sphere, one end of a tube.
  glm::dvec3 centre{0};
  glm::dvec3 axis{0, 1, 0};  // a disc's unit normal; from a tube's end to its other end
  double radius = 0;
  /// Factor on the radiance, linear rgb, row by row from the top; empty: 1 everywhere. Only
  /// parallelograms have one: its lower left corner is the first vertex, its lower right the
  /// second.
  Image texture;
};

/// What is wrong with the outline of a polygon, as the end of a sentence ("has 2 vertices, expected
/// 3 to 8"), or empty: too few or too many vertices, values that are not finite, equal neighbours,
/// no area, not flat, not convex.
std::string areaLightComplaint(const AreaLight& light);

/// Unit normal of the front of a polygon that has no complaint (right-hand rule) or of a disc; of a
/// tube the direction of its axis; of a sphere 0.
glm::dvec3 areaLightNormal(const AreaLight& light);
/// Area of the surface, both ends of a tube included, one side of a polygon or disc.
double areaLightArea(const AreaLight& light);

/// Two vectors as long as `radius`, at right angles to each other and to `axis`, right-handed with
/// it.
std::array<glm::dvec3, 2> lightRadii(const glm::dvec3& axis, double radius);

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
