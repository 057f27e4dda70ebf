// Polygon lights over a cosine: against closed forms and the double-precision form factor.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "host/core/angles.h"
#include "host/harness/polygon_cases.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

double lightAtOrigin(const CheckContext& context, const AreaLight& light, bool specular) {
  return lightPoints(context.bench, identityProbe(light, specular, context.lanes),
                     {HandMadePoint{}})[0]
      .x;
}

// The identity transform is the cosine itself, so its integral is the form factor.
Finding formFactor(const CheckContext& context, int corners) {
  const AreaLight light = regularPolygon(corners, true);
  const std::vector<HandMadePoint> points = randomPoints(2048, 1.5, 1);
  Finding finding(kFormFactorTolerance);
  for (const bool specular : {false, true}) {
    const auto values =
        lightPoints(context.bench, identityProbe(light, specular, context.lanes), points);
    for (std::size_t i = 0; i < points.size(); ++i)
      finding.add(std::abs(values[i].x - exactFormFactor(light, points[i])));
  }
  return finding;
}

Finding oneSided(const CheckContext& context) {
  const AreaLight light = regularPolygon(4, false);
  const std::vector<HandMadePoint> points = randomPoints(2048, 1.5, 2);
  const auto values =
      lightPoints(context.bench, identityProbe(light, false, context.lanes), points);
  Finding finding(kFormFactorTolerance);
  int lit = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    finding.add(std::abs(values[i].x - exactFormFactor(light, points[i])));
    const bool behind = points[i].position.z < 0;  // the front faces +z
    finding.require(!behind || values[i].x == 0, "the back is lit");
    lit += values[i].x > 0;
  }
  finding.require(lit > 100, "too few points are lit");
  return finding;
}

// Of a point below a corner of a parallel rectangle of sides a and b at distance 1: the textbook's
// closed form (Howell, configuration B-3).
double cornerFormFactor(double a, double b) {
  const double ra = std::sqrt(1 + a * a), rb = std::sqrt(1 + b * b);
  return (a / ra * std::atan(b / ra) + b / rb * std::atan(a / rb)) / (2 * kPi);
}

Finding parallelCorner(const CheckContext& context) {
  Finding finding(kFormFactorTolerance);
  for (const auto& [a, b] : {std::pair{1.0, 1.0}, {0.1, 3.0}, {20.0, 0.5}, {100.0, 100.0}}) {
    const AreaLight light = polygonLight(parallelRectangle(a / 2, b / 2, 1, a, b));
    finding.add(std::abs(lightAtOrigin(context, light, false) - cornerFormFactor(a, b)));
  }
  return finding;
}

// Squares whose centre is overhead: there is nothing to clip, and the form that does not clip is
// exact along the axis of the light.
Finding cliplessOverhead(const CheckContext& context) {
  Finding finding(kFormFactorTolerance);
  for (const double side : {0.1, 0.7, 2.0, 9.0, 50.0})
    for (const bool specular : {false, true}) {
      AreaLightProbe probe = identityProbe(polygonLight(parallelRectangle(0, 0, 1, side, side)),
                                           specular, context.lanes);
      probe.clipless = true;
      finding.add(std::abs(lightPoints(context.bench, probe, {HandMadePoint{}})[0].x -
                           4 * cornerFormFactor(side / 2, side / 2)));
    }
  return finding;
}

// A rectangle that stands on the receiver's plane at distance c, from its foot's corner: Howell's
// configuration B-5. Its lower edge lies exactly on the horizon.
Finding standing(const CheckContext& context) {
  Finding finding(kFormFactorTolerance);
  for (const auto& [width, height, distance] :
       {std::tuple{1.0, 1.0, 1.0}, {2.0, 0.3, 0.1}, {0.5, 10.0, 3.0}}) {
    const double x = width / distance, y = height / distance, r = std::sqrt(1 + y * y);
    const double exact = (std::atan(x) - std::atan(x / r) / r) / (2 * kPi);
    const AreaLight light = polygonLight(
        {{0, distance, 0}, {0, distance, height}, {width, distance, height}, {width, distance, 0}},
        true);
    finding.add(std::abs(lightAtOrigin(context, light, false) - exact));
  }
  return finding;
}

// 2 pi steradians reflect everything.
Finding hemisphere(const CheckContext& context) {
  const AreaLight light = polygonLight(parallelRectangle(0, 0, 1, 2e5, 2e5));
  Finding finding(kFormFactorTolerance);
  for (const bool specular : {false, true})
    finding.add(std::abs(lightAtOrigin(context, light, specular) - 1));
  return finding;
}

Finding solidAngles(const CheckContext& context, double least, double most, double bound) {
  Finding finding(bound);
  HandMadePoint point;
  point.position = {0.3, -0.2, 0};
  for (double omega = least; omega < most; omega *= 4) {
    const double side = std::sqrt(omega);
    const AreaLight light = polygonLight(parallelRectangle(0.5, 0.4, 1, side, side));
    const double value =
        lightPoints(context.bench, identityProbe(light, false, context.lanes), {point})[0].x;
    finding.add(std::abs(value / exactFormFactor(light, point) - 1));
  }
  return finding;
}

Finding samePolygonPoints(const CheckContext& context) {
  AreaLightProbe probe = identityProbe(regularPolygon(4, true), true, context.lanes);
  probe.lights.push_back(polygonLight(parallelRectangle(1, 1, 0.5, 2, 1)));
  const std::vector<HandMadePoint> points = randomPoints(777, 1.5, 3);
  Finding finding(0);
  for (const bool clipless : {false, true}) {
    probe.clipless = clipless;
    probe.width = context.lanes;
    const auto wide = lightPoints(context.bench, probe, points);
    probe.width = 1;
    const auto one = lightPoints(context.bench, probe, points);
    double different = 0;
    for (std::size_t i = 0; i < points.size(); ++i) different += one[i] != wide[i];
    finding.add(different);
  }
  return finding;
}

}  // namespace

std::vector<Check> polygonChecks() {
  std::vector<Check> checks;
  for (const int corners : {3, 4, 8})
    checks.push_back(
        {fmt::format("polygon/identity_{}_corners", corners), "error of form factors",
         [corners](const CheckContext& context) { return formFactor(context, corners); }});
  checks.insert(checks.end(),
                {{"polygon/one_sided", "error of form factors", oneSided},
                 {"polygon/parallel_corner", "error of form factors", parallelCorner},
                 {"polygon/clipless_overhead", "error of form factors", cliplessOverhead},
                 {"polygon/standing_on_horizon", "error of form factors", standing},
                 {"polygon/2pi_steradians", "error of form factors", hemisphere},
                 {"polygon/1e-10_to_1e-6_sr", "relative error",
                  [](const CheckContext& context) {
                    return solidAngles(context, 1e-10, 1e-6, kTinyLightRelative);
                  }},
                 {"polygon/1e-6_to_6_sr", "relative error",
                  [](const CheckContext& context) {
                    return solidAngles(context, 1e-6, 6, kSmallLightRelative);
                  }},
                 {"polygon/same_bits", "points that differ from one lane's", samePolygonPoints}});
  return checks;
}

}  // namespace glintmark
