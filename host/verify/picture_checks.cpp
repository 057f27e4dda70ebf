// Pictures on lights: what a lobe makes of one against the integral of lobe times picture over the
// light, point by point in double precision.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/core/angles.h"
#include "host/fit/ltc_lobe.h"
#include "host/harness/specular_cases.h"
#include "host/reference/ltc.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kTexels = 128, kSteps = 160;

// Red grows along the first edge, green along the second; blue has waves along both.
glm::dvec3 colourAt(double u, double v) {
  return {u, v, 0.5 + 0.5 * std::sin(2 * kPi * 2 * u) * std::cos(2 * kPi * 1.5 * v)};
}

AreaLight picturedLight() {
  AreaLight light =
      polygonLight({{-1, -0.8, 0}, {1.2, -0.6, 0.3}, {1.2, 0.9, 0.3}, {-1, 0.7, 0}}, true);
  light.texture = Image(kTexels, kTexels, 3);
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x) {
      const glm::dvec3 c =
          colourAt((x + 0.5) / kTexels, 1 - (y + 0.5) / kTexels);  // row 0 is the top
      for (int k = 0; k < 3; ++k)
        light.texture.at(x, y)[static_cast<std::size_t>(k)] = static_cast<float>(c[k]);
    }
  return light;
}

// The picture's mean under the density `lobe` of directions (frame of the point, above z = 0).
template <typename Lobe>
glm::dvec3 meanPicture(const AreaLight& light, const HandMadePoint& point, const glm::dvec3& x,
                       const glm::dvec3& y, Lobe&& lobe) {
  const glm::dvec3 along_u = light.vertices[1] - light.vertices[0],
                   along_v = light.vertices[3] - light.vertices[0];
  const glm::dvec3 normal = glm::cross(along_u, along_v);
  glm::dvec3 sum(0);
  double weights = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double u = (i + 0.5) / kSteps, v = (j + 0.5) / kSteps;
      const glm::dvec3 d = light.vertices[0] + u * along_u + v * along_v - point.position;
      const double length = glm::length(d);
      const glm::dvec3 local(glm::dot(x, d) / length, glm::dot(y, d) / length,
                             glm::dot(point.normal, d) / length);
      if (local.z <= 0) continue;
      const double weight =
          lobe(local) * std::abs(glm::dot(normal, d)) / (length * length * length);
      sum += weight * colourAt(u, v);
      weights += weight;
    }
  return weights > 0 ? sum / weights : glm::dvec3(-1);
}

struct PictureErrors {
  double gradients = 0, waves = 0;  // mean over points
};

// Points close before the light that face it more or less: a lobe sees a part of the picture, and
// no horizon cuts it.
std::vector<HandMadePoint> pointsBefore(const AreaLight& light) {
  std::mt19937 random(23);
  const auto unit = [&] { return std::uniform_real_distribution<double>()(random); };
  const glm::dvec3 along_u = light.vertices[1] - light.vertices[0],
                   along_v = light.vertices[3] - light.vertices[0];
  const glm::dvec3 out = glm::normalize(glm::cross(along_u, along_v));
  const auto tilted = [&](const glm::dvec3& d, double most) {
    const glm::dvec3 off(unit() - 0.5, unit() - 0.5, unit() - 0.5);
    return glm::normalize(glm::dvec3(glm::vec3(glm::normalize(d + most * off))));
  };
  std::vector<HandMadePoint> points(120);
  for (std::size_t i = 0; i < points.size(); ++i) {
    HandMadePoint& p = points[i];
    const double side = i % 2 == 0 ? 1 : -1;  // either face
    p.position = light.vertices[0] + (0.2 + 0.6 * unit()) * along_u +
                 (0.2 + 0.6 * unit()) * along_v + side * (0.1 + 0.4 * unit()) * out;
    p.position = glm::dvec3(glm::vec3(p.position));
    p.normal = tilted(-side * out, 0.7);
    p.view = tilted(p.normal, 1);
    p.alpha = 0.15 + 0.85 * unit();
  }
  return points;
}

PictureErrors pictureErrors(const CheckContext& context, bool specular) {
  const AreaLight light = picturedLight();
  AreaLight plain = light;
  plain.texture = Image();
  AreaLightProbe probe;
  probe.material = specular ? whiteSpecular() : whiteDiffuse();
  probe.table = shippedGgx();
  probe.width = context.lanes;
  const std::vector<HandMadePoint> points = pointsBefore(light);
  probe.lights = {light};
  const auto shown = lightPoints(context.bench, probe, points);
  probe.lights = {plain};
  const auto white = lightPoints(context.bench, probe, points);
  PictureErrors errors;
  const auto count = static_cast<double>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const HandMadePoint& p = points[i];
    const double cosine = glm::dot(p.view, p.normal);
    const glm::dvec3 x = glm::normalize(p.view - cosine * p.normal), y = glm::cross(p.normal, x);
    const glm::dmat3 inverse =
        ltcInverseMatrix(lookUpLtc(shippedGgx(), p.alpha, cosine), p.alpha, cosine);
    const glm::dvec3 want = meanPicture(light, p, x, y, [&](const glm::dvec3& d) {
      return specular ? reference::ltcDensity(inverse, d) : d.z;
    });
    const glm::dvec3 got = glm::dvec3(shown[i]) / glm::dvec3(white[i]);
    errors.gradients += 0.5 * (std::abs(got.x - want.x) + std::abs(got.y - want.y)) / count;
    errors.waves += std::abs(got.z - want.z) / count;
  }
  return errors;
}

// Where in the picture a lobe looks: pictures that grow along their sides. One direction and a box
// stand for the lobe, so their mean position is off by some hundredths of the light.
Finding picturePlace(const CheckContext& context, bool specular) {
  Finding finding(0.03);
  finding.add(pictureErrors(context, specular).gradients);
  return finding;
}

// How wide: waves of a half and of two thirds of the light that are blurred as the lobe would.
Finding pictureWidth(const CheckContext& context, bool specular) {
  Finding finding(0.025);
  finding.add(pictureErrors(context, specular).waves);
  return finding;
}

}  // namespace

std::vector<Check> pictureChecks() {
  std::vector<Check> checks;
  for (const bool specular : {false, true}) {
    const char* lobe = specular ? "specular" : "diffuse";
    checks.push_back({fmt::format("picture/{}_place", lobe), "mean error of gradients",
                      [specular](const CheckContext& c) { return picturePlace(c, specular); }});
    checks.push_back({fmt::format("picture/{}_width", lobe), "mean error of waves",
                      [specular](const CheckContext& c) { return pictureWidth(c, specular); }});
  }
  return checks;
}

}  // namespace glintmark
