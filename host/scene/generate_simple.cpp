// Plane, terrain, wavy sheet, disc and torus knot.
#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/scene/generators.h"
#include "host/scene/mesh_builder.h"
#include "host/scene/noise.h"

namespace glintmark {
namespace {

constexpr int kMaxGrid = 4096;

PartMesh onePatch(const std::string& part, int columns, int rows, const Surface& surface,
                  UvLayout layout = UvLayout::kFromSurface) {
  MeshBuilder builder;
  builder.addPatch(builder.part(part), columns, rows, surface, layout);
  return builder.finish();
}

/// A point of a square around the origin of the xz plane; t runs towards -z, so that the front is
/// up and v grows away from an eye at azimuth 0.
glm::dvec2 onSquare(double s, double t, double size) {
  return {(s - 0.5) * size, (0.5 - t) * size};
}

}  // namespace

MeshMaker readPlane(SceneTable& mesh) {
  const double size = mesh.number("size", 1, kPositive);
  return [size] {
    return onePatch("plane", 1, 1, [size](double s, double t) {
      const glm::dvec2 xz = onSquare(s, t, size);
      return SurfacePoint{{xz.x, 0, xz.y}, {xz.x, -xz.y}};
    });
  };
}

MeshMaker readTerrain(SceneTable& mesh) {
  const int columns = mesh.integer("columns", 126, 1, kMaxGrid);
  const int rows = mesh.integer("rows", 127, 1, kMaxGrid);
  const double size = mesh.number("size", 100, kPositive);
  const double height = mesh.number("height", 2, kNotNegative);
  const double wavelength = mesh.number("wavelength", 30, kPositive);
  const double ripple_height = mesh.number("ripple_height", 0, kNotNegative);
  const double ripple_wavelength = mesh.number("ripple_wavelength", 1, kPositive);
  const double rim_height = mesh.number("rim_height", 0, kNotNegative);
  const auto seed = static_cast<std::uint32_t>(mesh.integer("seed", 1, 0, 1 << 30));
  return [=] {
    const auto elevation = [=](const glm::dvec2& p) {
      const double hills = height * fractalNoise(p / wavelength, 4, 0.4, seed);
      if (ripple_height == 0 && rim_height == 0) return hills;
      // Wind ripples run along z and wander; they are sharper at the crest than in the trough.
      const double phase =
          p.x / ripple_wavelength + 1.5 * gradientNoise(p / (6 * ripple_wavelength), seed + 77);
      const double ripples = ripple_height * (1 - std::abs(std::sin(kPi * phase)));
      const double outside = std::clamp(2 * glm::length(p) / size - 0.6, 0.0, 1.0);
      if (rim_height == 0 || outside == 0) return hills + ripples;
      const double rim = rim_height * outside * outside *
                         (1 + fractalNoise(p * (3 / wavelength), 5, 0.5, seed + 99));
      return hills + ripples + rim;
    };
    return onePatch("ground", columns, rows, [=](double s, double t) {
      const glm::dvec2 xz = onSquare(s, t, size);
      return SurfacePoint{{xz.x, elevation(xz), xz.y}, {xz.x, -xz.y}};
    });
  };
}

MeshMaker readSheet(SceneTable& mesh) {
  const int columns = mesh.integer("columns", 200, 1, kMaxGrid);
  const int rows = mesh.integer("rows", 200, 1, kMaxGrid);
  const double size = mesh.number("size", 2, kPositive);
  const double height = mesh.number("height", 0.1, kNotNegative);
  const double waves = mesh.number("waves", 1.5, kNotNegative);
  return [=] {
    return onePatch("sheet", columns, rows, [=](double s, double t) {
      const glm::dvec2 xz = onSquare(s, t, size);
      const double y = height * (std::sin(2 * kPi * waves * (t + 0.25 * s)) * 0.7 +
                                 0.3 * std::sin(2 * kPi * waves * 1.7 * (s - 0.2 * t)));
      return SurfacePoint{{xz.x, y, xz.y}, {xz.x, -xz.y}};
    });
  };
}

MeshMaker readDisc(SceneTable& mesh) {
  const double radius = mesh.number("radius", 1, kPositive);
  const double hole = mesh.number("hole", 0.1, {0.001, 0.9});
  const int segments = mesh.integer("segments", 360, 3, kMaxGrid);
  const int rings = mesh.integer("rings", 60, 1, kMaxGrid);
  return [=] {
    MeshBuilder builder;
    // Polar uvs: u along the circle, so that grooves run round; v outwards. u is in scene units at
    // two thirds of the radius and stretched elsewhere, as in a texture.
    builder.addPatch(builder.part("disc"), segments, rings, [=](double s, double t) {
      const double angle = 2 * kPi * s, r = radius * glm::mix(hole, 1.0, t);
      return SurfacePoint{{r * std::sin(angle), 0, -r * std::cos(angle)},
                          {angle * radius * 2 / 3, r}};
    });
    builder.addPatch(builder.part("rim"), segments, 8, [=](double s, double t) {
      const double angle = 2 * kPi * s, bend = kPi * t, r = radius * (1 + 0.02 * std::sin(bend));
      return SurfacePoint{
          {r * std::sin(angle), -0.02 * radius * (1 - std::cos(bend)), -r * std::cos(angle)},
          {angle * radius, radius * (1 + 0.02 * bend)}};
    });
    return builder.finish();
  };
}

MeshMaker readKnot(SceneTable& mesh) {
  const double radius = mesh.number("radius", 1, kPositive);
  const double thickness = mesh.number("thickness", 0.35, kPositive);
  const int columns = mesh.integer("columns", 600, 3, kMaxGrid);
  const int rows = mesh.integer("rows", 80, 3, kMaxGrid);
  return [=] {
    // A (2, 3) torus knot: twice around the axis while three times around the ring.
    const auto centre = [radius](double s) {
      const double a = 2 * kPi * s, r = radius * (1 + 0.42 * std::cos(3 * a));
      return glm::dvec3(r * std::cos(2 * a), r * std::sin(2 * a), 0.62 * radius * std::sin(3 * a));
    };
    constexpr int kSteps = 2000;
    std::vector<double> length(kSteps + 1, 0);
    for (int i = 0; i < kSteps; ++i) {
      length[i + 1] =
          length[i] + glm::distance(centre(1.0 * i / kSteps), centre((i + 1.0) / kSteps));
    }
    return onePatch("knot", columns, rows, [=](double s, double t) {
      const glm::dvec3 along = glm::normalize(centre(s + 1e-4) - centre(s - 1e-4));
      const glm::dvec3 outwards = centre(s) - along * glm::dot(along, centre(s));
      const glm::dvec3 side = glm::normalize(outwards), up = glm::cross(along, side);
      const double turn = 2 * kPi * t;
      const int step = std::min(static_cast<int>(s * kSteps), kSteps - 1);
      return SurfacePoint{
          centre(s) + thickness * (std::cos(turn) * side - std::sin(turn) * up),
          {glm::mix(length[step], length[step + 1], s * kSteps - step), -turn * thickness}};
    });
  };
}

}  // namespace glintmark
