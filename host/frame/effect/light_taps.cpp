#include "host/frame/effect/light_taps.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "host/core/float4.h"
#include "host/frame/effect/light_tree.h"
#include "host/frame/effect/lights.h"
#include "host/ocl/upload.h"

namespace glintmark {
namespace {

int tapCount(const LightCone& cone) {
  if (cone.half_angle_rad <= kOneTapHalfAngle_rad) return 1;
  const double per_tap = 1.0 - std::cos(kTapHalfAngle_rad);
  return std::max(kLeastTaps, static_cast<int>(std::ceil(cone.one_minus_cos / per_tap)));
}

// Directions on a spiral that turns by the golden angle.
void appendTaps(const LightCone& cone, int count, std::vector<float4>& taps) {
  const glm::dvec3& axis = cone.axis;
  const glm::dvec3 helper = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 side = glm::normalize(glm::cross(helper, axis));
  const glm::dvec3 other = glm::cross(axis, side);
  const double golden_angle = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    // One tap stands in the middle; several in the middle of their rings.
    const double height = count == 1 ? 1.0 : 1.0 - cone.one_minus_cos * (i + 0.5) / count;
    const double radius = std::sqrt(std::max(0.0, 1.0 - height * height));
    const double phi = golden_angle * i;
    const glm::dvec3 d = axis * height + (side * std::cos(phi) + other * std::sin(phi)) * radius;
    taps.push_back(toFloat4(d));
  }
}

}  // namespace

PreparedTaps prepareTaps(std::span<const ConeLight> lights) {
  PreparedTaps taps;
  for (const ConeLight& light : lights) {
    const LightCone cone = coneOf(light);
    const int count = tapCount(cone);
    taps.lights.push_back({static_cast<uint>(taps.directions.size()), static_cast<uint>(count)});
    appendTaps(cone, count, taps.directions);
  }
  return taps;
}

namespace {

struct TapBuffers {
  Buffer lights, directions;
};

TapBuffers uploadTaps(FrameResources& frame) {
  const bool cuts = frame.options.light_cut != LightCut::kAll;
  const PreparedTaps taps =
      prepareTaps(cuts ? lightTree(frame.scene.lights).lights : frame.scene.lights);
  return {upload(frame.device, taps.lights, BufferPurpose::kLightTaps),
          upload(frame.device, taps.directions, BufferPurpose::kTaps)};
}

}  // namespace

void addLightTaps(FrameResources& frame, ShadeArguments& arguments) {
  const auto& taps = frame.kept<TapBuffers>([&] { return uploadTaps(frame); });
  arguments.add("light_taps", taps.lights);
  arguments.add("taps", taps.directions);
}

}  // namespace glintmark
