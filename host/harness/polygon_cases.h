// Polygon lights over a surface that reflects by a plain cosine, and their exact form factors.
#pragma once
#include <glm/glm.hpp>
#include <vector>

#include "host/harness/area_light_harness.h"

namespace glintmark {

/// A rectangle parallel to the plane z = 0 that faces down.
std::vector<glm::dvec3> parallelRectangle(double cx, double cy, double cz, double width,
                                          double height);

/// A regular polygon of circumradius 1 in the plane z = 0, front towards +z.
AreaLight regularPolygon(int corners, bool two_sided);

/// Form factor of the light from the point, in double precision.
double exactFormFactor(const AreaLight& light, const HandMadePoint& point);

/// Points all around the origin, with normals of all directions: most horizons cut the light.
std::vector<HandMadePoint> randomPoints(int count, double distance, std::uint32_t seed);

/// One light over a white diffuse surface or over the cosine as a transformed one.
AreaLightProbe identityProbe(const AreaLight& light, bool specular, int lanes);

}  // namespace glintmark
