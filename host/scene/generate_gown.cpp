// A gown on a dress form: a wide skirt in folds, a fitted bodice, and the form's shoulders and
// neck.
#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/scene/generators.h"
#include "host/scene/mesh_builder.h"
#include "host/scene/noise.h"

namespace glintmark {
namespace {

constexpr double kWaistHeight = 1.02;
constexpr double kTopHeight = 1.40;
constexpr double kHemRadius = 0.80;
constexpr double kWaistRadius = 0.125;
constexpr glm::dvec2 kHemOval(1.2, 0.9);  // the hem's width and depth over its radius
constexpr std::uint32_t kFoldSeed = 41;

/// Radius of the skirt without folds; `fall` is 0 at the waist and 1 at the hem. Flares at the hip.
double skirtRadius(double fall) {
  const double hip = 0.05 * std::sin(kPi * std::min(1.0, 1.15 * fall));
  return glm::mix(kWaistRadius, kHemRadius, fall) + hip;
}

/// Conformal uvs of a surface of revolution: a polar map whose fan angle per turn is `spread`, with
/// log(radius in uv) the integral of ds / r. For a cone of that spread it is its development, so
/// that uvs are in scene units nearly everywhere.
class SkirtChart {
 public:
  SkirtChart() {
    double travelled = 0;
    for (int i = 0; i <= kSteps; ++i) {
      logarithms_.push_back(travelled);
      const double fall = (i + 0.5) / kSteps;
      const double dr = (skirtRadius(fall + 0.5 / kSteps) - skirtRadius(fall - 0.5 / kSteps));
      travelled += kSpread * std::hypot(dr, kWaistHeight / kSteps) / skirtRadius(fall);
    }
  }

  glm::dvec2 uv(double angle, double fall) const {
    const double position = fall * kSteps;
    const int step = std::min(static_cast<int>(position), kSteps - 1);
    const double logarithm = glm::mix(logarithms_[step], logarithms_[step + 1], position - step);
    const double radius = kHemRadius / kSpread * std::exp(logarithm - logarithms_[kSteps]);
    return {radius * std::sin(kSpread * angle), -radius * std::cos(kSpread * angle)};
  }

 private:
  static constexpr int kSteps = 400;
  static constexpr double kSpread = 0.55;  // sine of the skirt's half-angle
  std::vector<double> logarithms_;
};

/// Offset of the folds from the plain skirt. They deepen towards the hem, differ in width, and are
/// rounder outside than in the creases.
double foldDepth(double angle, double fall, double folds, double depth) {
  const glm::dvec2 around(std::cos(angle), std::sin(angle));
  const double phase = folds * angle + 2.2 * gradientNoise(1.7 * around, kFoldSeed) +
                       1.2 * gradientNoise(around + glm::dvec2(0, 2 * fall), kFoldSeed + 1);
  const double wave = std::sin(phase) + 0.22 * std::cos(2 * phase);
  const double unevenness = 1 + 0.7 * gradientNoise(2.3 * around, kFoldSeed + 2);
  return depth * unevenness * wave * fall * std::sqrt(fall);
}

SurfacePoint bodicePoint(double angle, double t) {
  // Heart-shaped at the front, lower at the back.
  const double front = std::exp(-std::pow(angle / 0.9, 2));
  const double dip = 0.05 * std::exp(-std::pow(angle / 0.22, 2));
  const double top = kTopHeight - 0.10 + 0.10 * front - dip;
  const double y = glm::mix(kWaistHeight, top, t);
  const double rise = (y - kWaistHeight) / (kTopHeight - kWaistHeight);
  const double bust =
      0.035 * std::exp(-std::pow((rise - 0.72) / 0.24, 2)) *
      (std::exp(-std::pow((angle - 0.48) / 0.4, 2)) + std::exp(-std::pow((angle + 0.48) / 0.4, 2)));
  const double r = kWaistRadius + 0.045 * std::sin(0.5 * kPi * rise) + bust;
  return {{1.12 * r * std::sin(angle), y, 0.86 * r * std::cos(angle)}, {0.155 * angle + 4, y}};
}

SurfacePoint formPoint(double angle, double t) {
  // Chest, shoulders and neck: (radius across, radius in depth, height) by t.
  const double shoulder = std::exp(-std::pow((t - 0.38) / 0.2, 2));
  const double taper = 1 - glm::smoothstep(0.3, 0.72, t);
  const double across = 0.055 + 0.10 * taper + 0.045 * shoulder;
  const double depth = 0.055 + 0.065 * taper;
  const double cap = std::sqrt(std::max(0.0, 1 - std::pow(std::max(0.0, t - 0.9) / 0.1, 2)));
  const double y = 1.24 + 0.43 * t;
  return {{std::max(across * cap, 1e-4) * std::sin(angle), y,
           std::max(depth * cap, 1e-4) * std::cos(angle)},
          {0.12 * angle + 6, y}};
}

}  // namespace

MeshMaker readGown(SceneTable& mesh) {
  const int columns = mesh.integer("columns", 400, 8, 8192);
  const int rows = mesh.integer("rows", 95, 4, 8192);
  const double folds = mesh.integer("folds", 17, 0, 200);
  const double depth = mesh.number("fold_depth", 0.04, {0, 0.3});
  return [=] {
    MeshBuilder builder;
    const SkirtChart chart;
    // Angle 0 is the front (+z), the seam is at the back; s runs towards +x, t upwards.
    const auto angle_of = [](double s) { return 2 * kPi * (s - 0.5); };
    builder.addPatch(builder.part("skirt"), columns, rows, [&](double s, double t) {
      const double angle = angle_of(s), fall = 1 - t;
      const double r = skirtRadius(fall) + foldDepth(angle, fall, folds, depth);
      const glm::dvec2 oval = glm::mix(glm::dvec2(1), kHemOval, fall);
      return SurfacePoint{
          {oval.x * r * std::sin(angle), kWaistHeight * t, oval.y * r * std::cos(angle)},
          chart.uv(angle, fall)};
    });
    builder.addPatch(builder.part("bodice"), columns, std::max(1, rows * 5 / 19),
                     [&](double s, double t) { return bodicePoint(angle_of(s), t); });
    builder.addPatch(builder.part("form"), 80, 25,
                     [&](double s, double t) { return formPoint(angle_of(s), t); });
    return builder.finish();
  };
}

}  // namespace glintmark
