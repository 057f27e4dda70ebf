// The 8-byte shading frame: what goes in comes out, whatever the direction.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "host/core/frame_packing.h"

namespace glintmark {
namespace {

// Quantization to 2^-20 in octahedral coordinates, at worst stretched by about 2 on the sphere.
constexpr double kAngleBound_rad = 4e-6;

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

void expectRoundTrip(const glm::dvec3& n, const glm::dvec3& t, bool mirrored) {
  const ShadingFrame frame = unpackFrame(packFrame(n, t, mirrored));
  EXPECT_LT(angleBetween(frame.normal, n), kAngleBound_rad);
  EXPECT_LT(angleBetween(frame.tangent, t), kAngleBound_rad);
  const double handedness = glm::dot(glm::cross(frame.normal, frame.tangent), frame.bitangent);
  EXPECT_NEAR(handedness, mirrored ? -1.0 : 1.0, 1e-12);
}

TEST(FramePacking, RandomFramesSurvive) {
  std::mt19937 rng(1);
  std::normal_distribution<double> gauss;
  for (int i = 0; i < 100000; ++i) {
    const glm::dvec3 n = glm::normalize(glm::dvec3(gauss(rng), gauss(rng), gauss(rng)));
    const glm::dvec3 any(gauss(rng), gauss(rng), gauss(rng));
    expectRoundTrip(n, glm::normalize(any - n * glm::dot(n, any)), (i & 1) != 0);
    if (HasFailure()) return;
  }
}

TEST(FramePacking, AxesAndTheEquatorSurvive) {
  using std::numbers::pi;
  for (double z : {-1.0, -1e-12, 0.0, 1e-12, 1.0})
    for (int i = 0; i < 16; ++i) {
      const double phi = i * pi / 8, r = std::sqrt(1 - z * z);
      const glm::dvec3 n(r * std::cos(phi), r * std::sin(phi), z);
      const glm::dvec3 t = std::abs(z) == 1 ? glm::dvec3(std::cos(phi), std::sin(phi), 0)
                                            : glm::dvec3(-std::sin(phi), std::cos(phi), 0);
      expectRoundTrip(n, t, false);
    }
}

TEST(FramePacking, MissingTangentStillGivesAFrame) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(1, 2, -3));
  for (const glm::dvec3& t : {glm::dvec3(0), n}) {
    const ShadingFrame frame = unpackFrame(packFrame(n, t, false));
    EXPECT_NEAR(glm::length(frame.tangent), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(frame.tangent, frame.normal), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace glintmark
