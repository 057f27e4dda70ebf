// A rounded saloon car of smooth panels: body with fenders and wheel arches, cabin with windows,
// wheels, bumpers and lamps on a studio floor. x is forwards, lengths are metres.
#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/scene/generators.h"
#include "host/scene/mesh_builder.h"

namespace glintmark {
namespace {

constexpr double kHalfCar = 2.45;
constexpr double kAxle = 1.48;  // wheels stand at x = +-kAxle
constexpr double kWheelRadius = 0.34;
constexpr double kArchHalfWidth = 0.55;
constexpr double kArchHeight = 0.51;  // above the sill
constexpr double kTrack = 0.77;       // middle of a tyre

double square(double x) {
  return x * x;
}
double bell(double x, double width) {
  return std::exp(-square(x / width));
}

/// Point of the unit superellipse |y|^n + |z|^n = 1 at polar angle `angle`.
glm::dvec2 superellipse(double angle, double n) {
  const double c = std::cos(angle), s = std::sin(angle);
  return glm::dvec2(c, s) / std::pow(std::pow(std::abs(c), n) + std::pow(std::abs(s), n), 1 / n);
}

/// Where a section of the body begins to close towards nose and tail: 1 amidships, 0 at the ends.
double closing(double x, double half_length, double power) {
  return std::sqrt(std::max(0.0, 1 - std::pow(std::abs(x) / half_length, power)));
}

/// x along the body, denser where nose and tail bend.
double bodyX(double s) {
  return kHalfCar * std::sin(0.5 * kPi * (2 * s - 1));
}

struct BodySection {
  double half_width, bottom, top;
};

BodySection bodySection(double x) {
  constexpr double kMiddle = 0.56, kSill = 0.24;
  const double close = closing(x, kHalfCar, 14);
  const double hood = glm::smoothstep(0.7, 2.4, x), boot = glm::smoothstep(1.0, 2.4, -x);
  const double top = 0.96 - 0.11 * hood - 0.12 * boot;
  const double wheel_bulge = 0.05 * (bell(x - kAxle, 0.6) + bell(x + kAxle, 0.65));
  const double plan = 0.80 + 0.20 * closing(x, kHalfCar * 1.02, 5);
  return {(0.86 + wheel_bulge) * plan, kMiddle - (kMiddle - kSill) * close,
          kMiddle + (top - kMiddle) * close};
}

/// Height of the wheel arches above the sill: flat-topped, and nowhere so steep that a panel's grid
/// would tear.
double archRise(double x) {
  const double dx = std::min(std::abs(x - kAxle), std::abs(x + kAxle)) / kArchHalfWidth;
  return dx < 1 ? kArchHeight * (1 - std::pow(dx, 2.6)) : 0;
}

constexpr double kBodySquareness = 4.5;

/// The body's shell without wheel arches; `angle` runs over the section from one sill (0) across to
/// the other (pi).
glm::dvec3 shellPoint(double s, double angle) {
  const double x = bodyX(s);
  const BodySection section = bodySection(x);
  const double height = section.top - section.bottom;
  const glm::dvec2 unit = superellipse(angle, kBodySquareness);
  glm::dvec3 p(x, section.bottom + height * unit.y, section.half_width * unit.x);

  // Fenders stand above hood and boot, the hood has a ridge, the flanks a crease at half height.
  const double upper = square(unit.y), across = std::abs(unit.x);
  const double front = glm::smoothstep(0.3, 1.1, x) * bell(x - 1.5, 1.1);
  const double rear = glm::smoothstep(0.5, 1.3, -x) * bell(x + 1.55, 1.0);
  p.y += upper * bell(across - 0.80, 0.22) * (0.085 * front + 0.06 * rear);
  p.y += upper * bell(across, 0.28) * 0.045 * glm::smoothstep(0.6, 1.4, x) * bell(x - 1.5, 0.9);
  p.z *= 1 + 0.022 * bell(p.y - 0.62, 0.06) - 0.05 * square(std::max(0.0, 0.5 - p.y) / 0.3);
  return p;
}

/// Angle at grid line t of the shell that the wheel arches have cut. The section starts where the
/// arch cuts it: superellipse() inverted at that height. Only the panel's lower part gives way, so
/// that the grid above stays straight.
double trimmedAngle(double s, double t) {
  const BodySection section = bodySection(bodyX(s));
  const double height = std::max(section.top - section.bottom, 1e-6);
  const double cut = std::min(archRise(bodyX(s)) / height, 0.95);
  const double start =
      std::atan(cut / std::pow(1 - std::pow(cut, kBodySquareness), 1 / kBodySquareness));
  const double near_side = std::max(0.0, 1 - 2 * t), far_side = std::max(0.0, 2 * t - 1);
  return kPi * t + start * (near_side * near_side - far_side * far_side);
}

/// The uvs of the uncut shell, so that the arches cut the chart and do not bend it.
class ShellChart {
 public:
  ShellChart() {
    MeshBuilder builder;
    builder.addPatch(
        builder.part("shell"), kColumns, kRows,
        [](double s, double t) { return SurfacePoint{shellPoint(s, kPi * t)}; },
        UvLayout::kArcLength);
    uvs_ = builder.finish().mesh.uvs;
  }

  glm::dvec2 uv(double s, double angle) const {
    const double x = s * kColumns, y = angle / kPi * kRows;
    const int i = std::clamp(static_cast<int>(x), 0, kColumns - 1);
    const int j = std::clamp(static_cast<int>(y), 0, kRows - 1);
    return glm::mix(glm::mix(at(i, j), at(i + 1, j), x - i),
                    glm::mix(at(i, j + 1), at(i + 1, j + 1), x - i), y - j);
  }

 private:
  static constexpr int kColumns = 260, kRows = 130;
  const glm::dvec2& at(int i, int j) const {
    return uvs_[static_cast<std::size_t>(j) * (kColumns + 1) + i];
  }
  std::vector<glm::dvec2> uvs_;
};

void addBody(MeshBuilder& builder, int columns, int rows) {
  const ShellChart chart;
  builder.addPatch(builder.part("body"), columns, rows, [&chart](double s, double t) {
    const double angle = trimmedAngle(s, t);
    return SurfacePoint{shellPoint(s, angle), chart.uv(s, angle)};
  });
}

constexpr double kCabinMiddle = -0.52, kCabinHalfLength = 1.42;
constexpr double kBelt = 0.90, kCabinHeight = 0.53;

glm::dvec3 cabinPoint(double s, double t) {
  // Upright at the back, raked at the front.
  const double along = std::sin(0.5 * kPi * (2 * s - 1));
  const double x = kCabinMiddle + kCabinHalfLength * along;
  const double close = closing(along, 1, along > 0 ? 2.3 : 2.9);
  const glm::dvec2 unit = superellipse(kPi * t, 3.6);
  const double half_width = 0.74 * (0.86 + 0.14 * closing(along, 1.01, 4));
  const double height = kCabinHeight * close * unit.y;
  return {x, kBelt + height, half_width * unit.x * (1 - 0.30 * height / kCabinHeight)};
}

/// Windows in the cabin's own (s, t): bounded by grid lines, so that their edges are clean.
bool isWindow(double s, double t) {
  const double from_side = std::min(t, 1 - t);
  if (from_side > 0.055 && from_side < 0.215) {  // doors: two panes and a pillar each
    return (s > 0.235 && s < 0.475) || (s > 0.50 && s < 0.735);
  }
  const bool between_pillars = from_side > 0.275;
  return between_pillars && ((s > 0.80 && s < 0.955) || (s > 0.06 && s < 0.185));
}

glm::dvec3 onWheel(const glm::dvec3& hub, double side, double r, double angle, double out) {
  return hub + glm::dvec3(r * std::cos(angle), r * std::sin(angle), side * out);
}

void addWheel(MeshBuilder& builder, double x, double side) {
  const glm::dvec3 hub(x, kWheelRadius, side * kTrack);
  const auto turn = [side](double s) { return -side * 2 * kPi * s; };
  builder.addPatch(
      builder.part("tyre"), 96, 32,
      [=](double s, double t) {
        const glm::dvec2 ring = superellipse(2 * kPi * t, 3.5);
        const double r = kWheelRadius - 0.065 + 0.065 * ring.y;
        return SurfacePoint{onWheel(hub, side, r, turn(s), -0.105 * ring.x)};
      },
      UvLayout::kArcLength);
  builder.addPatch(
      builder.part("rim"), 96, 20,
      [=](double s, double t) {
        // A hub cap: a dome in a dished ring.
        const double r = glm::mix(0.225, 0.004, t);
        const double out = 0.075 - 0.05 * bell(r - 0.16, 0.045) + 0.03 * bell(r, 0.09);
        return SurfacePoint{onWheel(hub, side, r, turn(s), out)};
      },
      UvLayout::kArcLength);
}

void addBumper(MeshBuilder& builder, double end) {
  builder.addPatch(
      builder.part("chrome"), 100, 16,
      [end](double s, double t) {
        // A bent tube that follows the nose; its ends turn back along the flanks.
        const double a = 1.5 * (2 * s - 1);
        const glm::dvec3 spine(kHalfCar - 0.28 + 0.36 * std::pow(std::cos(a), 0.45), 0.46,
                               0.90 * std::sin(a));
        const glm::dvec3 outwards = glm::normalize(glm::dvec3(std::cos(a) + 0.05, 0, std::sin(a)));
        const glm::dvec2 ring = superellipse(2 * kPi * t, 2.6);
        const glm::dvec3 p = spine + outwards * (0.04 * ring.x) + glm::dvec3(0, 0.075 * ring.y, 0);
        return SurfacePoint{{end * p.x, p.y, -end * p.z}};
      },
      UvLayout::kArcLength);
}

void addLamp(MeshBuilder& builder, double end, double side) {
  builder.addPatch(
      builder.part("lamp"), 32, 16,
      [=](double s, double t) {
        const double a = -end * 2 * kPi * s, bend = 0.5 * kPi * glm::mix(1.0, 0.02, t);
        const double r = 0.105 * std::sin(bend);
        return SurfacePoint{{end * (2.36 + 0.09 * std::cos(bend)), 0.70 + r * std::sin(a),
                             side * 0.60 + r * std::cos(a)}};
      },
      UvLayout::kArcLength);
}

/// Closes nose and tail below their edge.
void addApron(MeshBuilder& builder, double end) {
  builder.addPatch(
      builder.part("apron"), 24, 8,
      [end](double s, double t) {
        const double z = end * 0.73 * (1 - 2 * s);
        return SurfacePoint{{end * (2.20 + 0.23 * std::sqrt(1 - 0.9 * square(1 - t))),
                             glm::mix(0.25, 0.575, t), z}};
      },
      UvLayout::kArcLength);
}

void addUnderbody(MeshBuilder& builder) {
  builder.addPatch(
      builder.part("underbody"), 40, 24,
      [](double s, double t) {
        const glm::dvec2 ring = superellipse(2 * kPi * t, 6);
        return SurfacePoint{{2.0 * (2 * s - 1), 0.47 + 0.24 * ring.y, 0.62 * ring.x}};
      },
      UvLayout::kArcLength);
}

/// Two walls in a corner behind the car, at x = -distance and z = -distance.
void addWalls(MeshBuilder& builder, double distance, double length, double height) {
  builder.addPatch(
      builder.part("wall"), 16, 16,
      [=](double s, double t) {
        return SurfacePoint{{-distance, height * t, length * (0.5 - s)}};
      },
      UvLayout::kArcLength);
  builder.addPatch(
      builder.part("wall"), 16, 16,
      [=](double s, double t) {
        return SurfacePoint{{length * (s - 0.5), height * t, -distance}};
      },
      UvLayout::kArcLength);
}

}  // namespace

MeshMaker readCar(SceneTable& mesh) {
  const double detail = mesh.number("detail", 1, {0.05, 4});
  const double floor_size = mesh.number("floor_size", 60, kPositive);
  const double wall_distance = mesh.number("wall_distance", 0, kNotNegative);
  const double wall_height = mesh.number("wall_height", 6, kPositive);
  return [=] {
    const auto steps = [detail](int n) {
      return std::max(4, static_cast<int>(std::lround(n * detail)));
    };
    MeshBuilder builder;
    addBody(builder, steps(780), steps(260));
    const std::uint32_t roof = builder.part("roof"), window = builder.part("window");
    builder.addPatch([=](double s, double t) { return isWindow(s, t) ? window : roof; }, steps(290),
                     steps(200), [](double s, double t) { return SurfacePoint{cabinPoint(s, t)}; },
                     UvLayout::kArcLength);
    for (const double end : {1.0, -1.0}) {
      addBumper(builder, end);
      addApron(builder, end);
      for (const double side : {1.0, -1.0}) {
        addWheel(builder, end * kAxle, side);
        addLamp(builder, end, side);
      }
    }
    addUnderbody(builder);
    builder.addPatch(
        builder.part("floor"), 16, 16,
        [=](double s, double t) {
          return SurfacePoint{{(s - 0.5) * floor_size, 0, (0.5 - t) * floor_size}};
        },
        UvLayout::kArcLength);
    if (wall_distance > 0) addWalls(builder, wall_distance, floor_size, wall_height);
    // Grooves run along u: turned by 90 degrees, the charts have u across the car.
    PartMesh car = builder.finish();
    for (glm::dvec2& uv : car.mesh.uvs) uv = {uv.y, -uv.x};
    return car;
  };
}

}  // namespace glintmark
