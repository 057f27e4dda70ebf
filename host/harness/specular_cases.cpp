#include "host/harness/specular_cases.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace glintmark {

const LtcTable& shippedGgx() {
  static const LtcTable table = shippedLtcTable(reference::Ndf::kGgx);
  return table;
}

AreaLight specularQuad() {
  return polygonLight({{-1, -0.7, 0}, {1, -0.7, 0}, {1, 0.7, 0}, {-1, 0.7, 0}}, true);
}

std::vector<SpecularCase> specularCases(int count, const AreaLight& light, double least_alpha) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto direction = [&] {
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  };
  std::vector<SpecularCase> cases;
  while (static_cast<int>(cases.size()) < count) {
    SpecularCase c;
    c.point.position = glm::dvec3(glm::vec3(2.0 * direction()));
    c.point.normal = glm::normalize(glm::dvec3(glm::vec3(direction())));
    c.point.view = glm::normalize(glm::dvec3(glm::vec3(direction())));
    const double cosine = glm::dot(c.point.view, c.point.normal);
    if (cosine < 0.05) continue;
    c.point.alpha = std::max(least_alpha, std::pow(uniform(random), 2));
    const glm::dvec3 x = glm::normalize(c.point.view - cosine * c.point.normal);
    const glm::dvec3 y = glm::cross(c.point.normal, x);
    for (const glm::dvec3& v : light.vertices) {
      const glm::dvec3 d = v - c.point.position;
      c.local.emplace_back(glm::dot(x, d), glm::dot(y, d), glm::dot(c.point.normal, d));
    }
    cases.push_back(c);
  }
  return cases;
}

std::vector<glm::vec3> shadeSpecular(KernelBench& bench, const AreaLight& light,
                                     const std::vector<SpecularCase>& cases, int lanes) {
  AreaLightProbe probe;
  probe.material = whiteSpecular();
  probe.lights = {light};
  probe.table = shippedGgx();
  probe.width = lanes;
  std::vector<HandMadePoint> points;
  points.reserve(cases.size());
  for (const SpecularCase& c : cases) points.push_back(c.point);
  return lightPoints(bench, probe, points);
}

}  // namespace glintmark
