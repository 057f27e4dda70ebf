#include "host/harness/polygon_cases.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "host/reference/polygon_light.h"

namespace glintmark {
namespace {

// The light's vertices seen from a point, z along its normal.
std::vector<glm::dvec3> inFrame(const AreaLight& light, const HandMadePoint& point) {
  const glm::dvec3 n = point.normal;
  const glm::dvec3 axis = std::abs(n.x) > 0.6 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 t = glm::normalize(axis - n * glm::dot(axis, n)), b = glm::cross(n, t);
  std::vector<glm::dvec3> local;
  for (const glm::dvec3& v : light.vertices) {
    const glm::dvec3 d = v - point.position;
    local.emplace_back(glm::dot(t, d), glm::dot(b, d), glm::dot(n, d));
  }
  return local;
}

}  // namespace

std::vector<glm::dvec3> parallelRectangle(double cx, double cy, double cz, double width,
                                          double height) {
  return rectangleVertices({cx, cy, cz}, {0, 0, -1}, {0, 1, 0}, {width, height});
}

AreaLight regularPolygon(int corners, bool two_sided) {
  std::vector<glm::dvec3> vertices;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    vertices.emplace_back(std::cos(angle), std::sin(angle), 0);
  }
  return polygonLight(vertices, two_sided);
}

double exactFormFactor(const AreaLight& light, const HandMadePoint& point) {
  // Counter-clockwise from the front is clockwise about the direction to the light.
  const double signed_factor = -reference::polygonFormFactor(inFrame(light, point));
  return light.two_sided ? std::abs(signed_factor) : std::max(signed_factor, 0.0);
}

std::vector<HandMadePoint> randomPoints(int count, double distance, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::vector<HandMadePoint> points;
  for (int i = 0; i < count; ++i) {
    HandMadePoint p;
    p.position = distance * glm::dvec3(normal(random), normal(random), normal(random));
    p.normal = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    // Values as the kernel gets them.
    p.position = glm::dvec3(glm::vec3(p.position));
    p.normal = glm::normalize(glm::dvec3(glm::vec3(p.normal)));
    p.view = p.normal;
    points.push_back(p);
  }
  return points;
}

AreaLightProbe identityProbe(const AreaLight& light, bool specular, int lanes) {
  AreaLightProbe probe;
  probe.material = specular ? whiteSpecular() : whiteDiffuse();
  probe.lights = {light};
  probe.table = identityTable();
  probe.width = lanes;
  return probe;
}

}  // namespace glintmark
