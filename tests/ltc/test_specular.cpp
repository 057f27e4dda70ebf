// Polygon lights over transformed cosines: against the double-precision lobe and the BRDF itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/fit/ltc_lobe.h"
#include "host/reference/polygon_light.h"
#include "host/reference/scaled_cosine.h"
#include "tests/glint/pixel_harness.h"
#include "tests/ltc/area_light_harness.h"

namespace glintmark {
namespace {

// The same lobe in double precision: interpolation and a dozen terms in single precision. Lobes of
// roughness alpha turn an error of direction of 1e-7 into 1e-7 / alpha.
constexpr double kSameLobe = 2e-4;
// The lobe against the BRDF it was fitted to. The published tables are off by as much at grazing
// angles, where a cosine lobe lacks the BRDF's tail.
constexpr double kFitTolerance = 0.06;

const LtcTable& ggxTable() {
  static const LtcTable table = shippedLtcTable(reference::Ndf::kGgx);
  return table;
}

struct RandomCase {
  HandMadePoint point;
  std::vector<glm::dvec3>
      local;  // the light's vertices in the table's frame, front counter-clockwise
};

AreaLight quadLight() {
  return polygonLight({{-1, -0.7, 0}, {1, -0.7, 0}, {1, 0.7, 0}, {-1, 0.7, 0}}, true);
}

std::vector<RandomCase> randomCases(int count, const AreaLight& light, double least_alpha) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const auto direction = [&] {
    return glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
  };
  std::vector<RandomCase> cases;
  while (static_cast<int>(cases.size()) < count) {
    RandomCase c;
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

std::vector<glm::vec3> shade(const AreaLight& light, const std::vector<RandomCase>& cases,
                             int width = 16) {
  AreaLightProbe probe;
  probe.material = whiteSpecular();
  probe.lights = {light};
  probe.table = ggxTable();
  probe.width = width;
  std::vector<HandMadePoint> points;
  for (const RandomCase& c : cases) points.push_back(c.point);
  return lightPoints(probe, points);
}

TEST(Specular, KernelIsTheLobeInDoublePrecision) {
  const AreaLight light = quadLight();
  const std::vector<RandomCase> cases = randomCases(1024, light, 0.01);
  const std::vector<glm::vec3> values = shade(light, cases);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double cosine = glm::dot(cases[i].point.view, cases[i].point.normal);
    const LtcCell cell = lookUpLtc(ggxTable(), cases[i].point.alpha, cosine);
    const glm::dmat3 inverse = ltcInverseMatrix(cell, cases[i].point.alpha, cosine);
    const std::vector<glm::dvec3> clipped = reference::clipPolygon(cases[i].local, {0, 0, 1});
    const double exact =
        clipped.empty() ? 0 : cell.scale * std::abs(reference::ltcOverPolygon(inverse, clipped));
    EXPECT_NEAR(values[i].x, exact, kSameLobe) << "alpha " << cases[i].point.alpha;
  }
}

TEST(Specular, LobeIsTheBrdfWithinTheFit) {
  const AreaLight light = quadLight();
  const std::vector<RandomCase> cases = randomCases(96, light, 0.05);
  const std::vector<glm::vec3> values = shade(light, cases);
  double sum = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const RandomCase& c = cases[i];
    const double cosine = glm::dot(c.point.view, c.point.normal);
    const glm::dvec3 view{std::sqrt(1 - cosine * cosine), 0, cosine};
    const glm::dmat3 inverse =
        ltcInverseMatrix(lookUpLtc(ggxTable(), c.point.alpha, cosine), c.point.alpha, cosine);
    const double exact = std::abs(reference::microfacetOverPolygon(
        reference::Ndf::kGgx, view, c.point.alpha, 1, inverse, c.local));
    EXPECT_NEAR(values[i].x, exact, kFitTolerance)
        << "alpha " << c.point.alpha << " cosine " << cosine;
    sum += std::abs(values[i].x - exact);
  }
  EXPECT_LT(sum / static_cast<double>(cases.size()), kFitTolerance / 5);
}

TEST(Specular, HemisphereReflectsTheDirectionalAlbedo) {
  AreaLightProbe probe;
  probe.material = whiteSpecular();
  probe.table = ggxTable();
  probe.lights = {polygonLight(rectangleVertices({0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {2e5, 2e5}))};
  for (const double alpha : {0.03, 0.3, 1.0})
    for (const double cosine : {1.0, 0.6, 0.2}) {
      HandMadePoint point;
      point.alpha = alpha;
      point.view = {std::sqrt(1 - cosine * cosine), 0, cosine};
      const double albedo = lookUpLtc(ggxTable(), alpha, cosine).albedo;
      EXPECT_NEAR(lightPoints(probe, {point})[0].x, albedo, 2e-3) << alpha << " " << cosine;
    }
}

TEST(Specular, LanesAgreeBitForBit) {
  const AreaLight light = quadLight();
  const std::vector<RandomCase> cases = randomCases(500, light, 1e-3);
  EXPECT_EQ(shade(light, cases, 16), shade(light, cases, 1));
}

struct HardLight {
  const char* name;
  std::vector<glm::dvec3> vertices;
};

// Every light against every view, roughness and lane count: finite, never negative, never more than
// the light's radiance.
TEST(Specular, HardCases) {
  const HardLight lights[] = {
      {"crosses the horizon", {{1, -1, -1}, {1, 1, -1}, {1, 1, 1}, {1, -1, 1}}},
      {"below", {{1, -1, -1}, {1, 1, -1}, {1, 1, -2}, {1, -1, -2}}},
      {"edge-on", {{1, 0, 0.5}, {2, 0, 0.5}, {2, 0, 1.5}, {1, 0, 1.5}}},
      {"in the surface", {{1, -1, 0}, {2, -1, 0}, {2, 1, 0}, {1, 1, 0}}},
      {"around the point, in the surface", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}},
      {"vertex at the point", {{0, 0, 0}, {1, 0, 0.5}, {1, 1, 0.5}, {0, 1, 0}}},
      {"edge through the point", {{-1, 0, 0}, {1, 0, 0}, {1, 0.1, 1}, {-1, 0.1, 1}}},
      {"touches the surface", {{-1, 1, 0}, {1, 1, 0}, {1, 1, 1}, {-1, 1, 1}}},
      {"a hair above",
       {{-1e4, -1e4, 1e-6}, {-1e4, 1e4, 1e-6}, {1e4, 1e4, 1e-6}, {1e4, -1e4, 1e-6}}},
      {"a line", {{-1, 0, 1}, {1, 0, 1}, {1, 1e-7, 1}, {-1, 1e-7, 1}}},
      {"a speck", {{0, 0, 1}, {1e-5, 0, 1}, {1e-5, 1e-5, 1}, {0, 1e-5, 1}}},
      {"far away", {{1e6, 0, 1e6}, {1e6, 1e3, 1e6}, {1e6, 1e3, 1.001e6}, {1e6, 0, 1.001e6}}},
      {"a sliver", {{-1e3, 0, 0.1}, {1e3, 0, 0.1}, {1e3, 1e-3, 0.1}, {-1e3, 1e-3, 0.1}}}};
  std::vector<HandMadePoint> points;
  for (const double alpha : {0.001, 0.01, 0.1, 1.0})
    for (const double angle_deg : {90.0, 89.9999, 45.0, 1.0, 0.1, -5.0})
      for (const double azimuth : {0.0, 1.0, 4.0}) {
        HandMadePoint p;
        const double angle = angle_deg * 3.14159265358979 / 180;
        p.view = {std::cos(angle) * std::cos(azimuth), std::cos(angle) * std::sin(azimuth),
                  std::sin(angle)};
        p.alpha = alpha;
        points.push_back(p);
      }
  for (const HardLight& light : lights) {
    AreaLightProbe probe;
    probe.material = whiteSpecular();
    probe.material.albedo = {1, 1, 1, 0};
    probe.table = ggxTable();
    probe.lights = {polygonLight(light.vertices, true)};
    for (const bool clipless : {false, true}) {
      probe.clipless = clipless;
      for (const glm::vec3& value : lightPoints(probe, points)) {
        EXPECT_TRUE(std::isfinite(value.x) && value.x >= 0) << light.name << " " << value.x;
        EXPECT_LT(value.x, 2.2) << light.name
                                << ": diffuse and specular reflect at most everything";
      }
    }
  }
}

TEST(Meso, KernelsFollowTheReferences) {
  std::vector<float> lengths;
  for (float length = 0; length <= 1.0005f; length += 0.0005f) lengths.push_back(length);
  for (const float micro : {0.001f, 0.03f, 0.3f, 1.0f}) {
    const std::vector<float> tao21 = footprintAlphas(LtcMethod::kTao21, micro, lengths, 16);
    const std::vector<float> exact = footprintAlphas(LtcMethod::kExact, micro, lengths, 16);
    const std::vector<float> original = footprintAlphas(LtcMethod::kOriginal, micro, lengths, 16);
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      EXPECT_EQ(original[i], micro);
      EXPECT_NEAR(tao21[i],
                  reference::tao21OverallAlpha(micro, reference::tao21MesoAlpha(lengths[i])), 1e-5);
      EXPECT_GE(exact[i], micro) << "never smoother than the material";
      EXPECT_LE(exact[i], 1);
      if (i > 0 && lengths[i] < 1) {
        EXPECT_LE(exact[i], exact[i - 1] + 1e-6f) << "longer means are smoother";
      }
    }
    EXPECT_EQ(exact.back(), micro) << "the identity without meso roughness";
    EXPECT_EQ(exact, footprintAlphas(LtcMethod::kExact, micro, lengths, 1));
  }
}

}  // namespace
}  // namespace glintmark
