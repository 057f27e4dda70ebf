// A court between two-storey arcades, after the atrium of Sponza palace: columns, round arches,
// galleries, cornices, and banners between the columns. x is along the court, lengths are metres.
#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/scene/generators.h"
#include "host/scene/mesh_builder.h"
#include "host/scene/noise.h"

namespace glintmark {
namespace {

constexpr int kBays = 8;
constexpr double kBayLength = 3.0;
constexpr double kHalfArcade = kBays * kBayLength / 2;
constexpr double kCourtHalfWidth = 4.0;  // to the arcade's front
constexpr double kWallThickness = 0.6;
constexpr double kAisleBack = 7.2;
constexpr double kStoreyHeight = 4.8;
constexpr double kSpringing = 3.0;  // of the arches, above their storey's floor
constexpr double kArchRadius = 1.22;
constexpr double kParapetTop = 2 * kStoreyHeight + 0.9;

/// Maps the arcade at z > 0 to either side of the court: a half turn, so that fronts stay fronts.
glm::dvec3 toSide(const glm::dvec3& p, double side) {
  return {side * p.x, p.y, side * p.z};
}

class ArcadeBuilder {
 public:
  explicit ArcadeBuilder(double detail) : detail_(detail) {}

  PartMesh build() {
    addRectangle("floor", {-kHalfArcade, 0, kAisleBack}, {2 * kHalfArcade, 0, 0},
                 {0, 0, -2 * kAisleBack}, 96, 56);
    for (const double side : {1.0, -1.0}) {
      addLongSide(side);
      addEndWall(side);
    }
    return builder_.finish();
  }

 private:
  int steps(int n) const { return std::max(1, static_cast<int>(std::lround(n * detail_))); }

  void add(const std::string& part, int columns, int rows, double side,
           const std::function<glm::dvec3(double s, double t)>& surface) {
    builder_.addPatch(
        builder_.part(part), steps(columns), steps(rows),
        [&surface, side](double s, double t) { return SurfacePoint{toSide(surface(s, t), side)}; },
        UvLayout::kArcLength);
  }

  /// A rectangle whose front is the side that edge_s x edge_t points to.
  void addRectangle(const std::string& part, const glm::dvec3& corner, const glm::dvec3& edge_s,
                    const glm::dvec3& edge_t, int columns, int rows, double side = 1) {
    add(part, columns, rows, side,
        [=](double s, double t) { return corner + s * edge_s + t * edge_t; });
  }

  void addLongSide(double side) {
    for (int storey = 0; storey < 2; ++storey) {
      const double base = storey * kStoreyHeight;
      for (int i = 0; i <= kBays; ++i) addColumn(side, base, -kHalfArcade + i * kBayLength);
      for (int i = 0; i < kBays; ++i) addArch(side, base, -kHalfArcade + (i + 0.5) * kBayLength);
      addCornice(side, base + kStoreyHeight);
    }
    const glm::dvec3 along(2 * kHalfArcade, 0, 0);
    const double aisle = kAisleBack - kCourtHalfWidth;
    addRectangle("wall", {kHalfArcade, 0, kAisleBack}, -along, {0, kParapetTop, 0}, 96, 44, side);
    addRectangle("floor", {-kHalfArcade, kStoreyHeight, kAisleBack}, along, {0, 0, -aisle}, 96, 12,
                 side);
    for (int storey = 1; storey <= 2; ++storey) {
      addRectangle("wall", {-kHalfArcade, storey * kStoreyHeight - 0.05, kCourtHalfWidth}, along,
                   {0, 0, aisle}, 96, 12, side);
    }
    addRectangle("wall", {kHalfArcade, 2 * kStoreyHeight, kCourtHalfWidth}, -along,
                 {0, kParapetTop - 2 * kStoreyHeight, 0}, 96, 4, side);
    constexpr const char* kFabrics[] = {"fabric_red", "fabric_green", "fabric_blue"};
    for (int i = 0; i < kBays; i += 2) {
      addBanner(kFabrics[(i / 2 + (side > 0 ? 0 : 1)) % 3], side,
                -kHalfArcade + (i + (side > 0 ? 0.5 : 1.5)) * kBayLength, 60 + i);
    }
  }

  void addEndWall(double side) {
    addRectangle("wall", {-kHalfArcade, 0, kAisleBack}, {0, 0, -2 * kAisleBack},
                 {0, kParapetTop, 0}, 48, 36, side);
    add("wall", 48, 12, side, [](double s, double t) {
      // A half-round moulding across the wall, level with the gallery.
      const double a = kPi * (t - 0.5);
      return glm::dvec3(-kHalfArcade + 0.18 * std::cos(a), kStoreyHeight + 0.18 * std::sin(a),
                        kCourtHalfWidth * (1 - 2 * s));
    });
  }

  void addColumn(double side, double base, double x) {
    const double z = kCourtHalfWidth + kWallThickness / 2;
    add("column", 30, 37, side, [=](double s, double t) {
      const double a = -2 * kPi * s, y = kSpringing * t;
      // Two rings at the foot, a swelling shaft, a bell capital with its ring.
      const double foot = 0.12 * std::exp(-std::pow(y / 0.14, 4)) +
                          0.07 * std::exp(-std::pow((y - 0.24) / 0.07, 2));
      const double shaft = 0.215 - 0.035 * std::pow(t, 1.5);
      const double capital =
          0.17 * glm::smoothstep(2.55, 3.0, y) + 0.05 * std::exp(-std::pow((y - 2.5) / 0.05, 2));
      const double r = shaft + foot + capital;
      return glm::dvec3(x + r * std::cos(a), base + y, z + r * std::sin(a));
    });
  }

  /// One bay of the wall above the columns: two faces, the arch's underside and what rests on the
  /// capitals.
  void addArch(double side, double base, double x) {
    const double pier = kBayLength / 2 - kArchRadius;
    const double front = kCourtHalfWidth, back = kCourtHalfWidth + kWallThickness;
    const auto edge = [=](double s) {
      const double a = kPi * (1 - s);
      return glm::dvec2(x + kArchRadius * std::cos(a),
                        base + kSpringing + kArchRadius * std::sin(a));
    };
    const double top = base + kStoreyHeight;
    for (const bool is_front : {true, false}) {
      const double z = is_front ? front : back;
      add("wall", 36, 10, side, [=](double s, double t) {
        const glm::dvec2 low = edge(is_front ? 1 - s : s);
        return glm::dvec3(low.x, glm::mix(low.y, top, t), z);
      });
      for (const double end : {-1.0, 1.0}) {
        const double near = x + end * kArchRadius, far = x + end * kBayLength / 2;
        const double from = (end > 0) == is_front ? far : near, to = near + far - from;
        addRectangle("wall", {from, base + kSpringing, z}, {to - from, 0, 0},
                     {0, kStoreyHeight - kSpringing, 0}, 2, 6, side);
      }
    }
    add("wall", 36, 6, side, [=](double s, double t) {
      const glm::dvec2 p = edge(s);
      return glm::dvec3(p, glm::mix(front, back, t));
    });
    for (const double from : {x - kBayLength / 2, x + kArchRadius}) {
      addRectangle("wall", {from, base + kSpringing, front}, {pier, 0, 0}, {0, 0, kWallThickness},
                   2, 4, side);
    }
  }

  void addCornice(double side, double y) {
    add("wall", 96, 16, side, [=](double s, double t) {
      // From below: a quarter round, a fillet, and a slope back to the wall.
      const double a = 0.5 * kPi * std::min(1.0, 2 * t);
      const double up = t < 0.5 ? 0.16 * std::sin(a) : 0.16 + 0.10 * (2 * t - 1);
      const double out = t < 0.5 ? 0.22 * (1 - std::cos(a)) : 0.22 * (1 - std::pow(2 * t - 1, 4));
      return glm::dvec3(kHalfArcade * (1 - 2 * s), y - 0.13 + up, kCourtHalfWidth - out);
    });
  }

  void addBanner(const std::string& part, double side, double x, int seed) {
    constexpr double kWidth = 1.9, kTop = 2 * kStoreyHeight - 0.75, kDrop = 4.6;
    add(part, 48, 72, side, [=](double s, double t) {
      const double across = s - 0.5, fall = 1 - t;
      const double phase =
          5 * 2 * kPi *
          (across + 0.1 * gradientNoise({3 * across, 2 * fall}, static_cast<std::uint32_t>(seed)));
      const double fold = 0.055 * std::sin(phase) * (0.35 + 0.65 * fall);
      const double gather = 1 - 0.12 * std::sin(kPi * fall);
      return glm::dvec3(x - kWidth * gather * across, kTop - kDrop * fall,
                        kCourtHalfWidth - 0.38 + fold + 0.08 * fall * fall);
    });
  }

  MeshBuilder builder_;
  double detail_;
};

}  // namespace

MeshMaker readArcade(SceneTable& mesh) {
  const double detail = mesh.number("detail", 1, {0.1, 4});
  return [detail] { return ArcadeBuilder(detail).build(); };
}

}  // namespace glintmark
