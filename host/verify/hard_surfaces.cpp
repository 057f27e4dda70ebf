// Hard materials, views and lights.
#include <cmath>
#include <numbers>

#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/verify/hard_case.h"

namespace glintmark {
namespace {

void microRoughnessEqualsGlobalRoughness(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.material.glints.alpha_l = frame.material.surface.alpha_g;
  hard.expectReference(frame);
}

void roughnessNearZero(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.material = simpleMaterial({1e-4f, 1e-4f}, {1e-4f, 1e-4f}, 1e6f);
  hard.shadeSanely(frame);
  frame.ray_origin = {-0.3 * 0.9, -0.2 * 0.9, -0.81};  // about the mirror direction
  hard.shadeSanely(frame);
  frame.material.glints.alpha_l = {1e-5f, 1e-5f};
  hard.shadeSanely(frame);
}

void roughnessOfOneAxisAThousandTimesTheOther(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.material = simpleMaterial({0.5f, 5e-4f}, {5e-4f, 4e-4f}, 1e6f);
  frame.lights = {coneLight({0.3, 0.0, 0.9})};
  frame.ray_origin = {0.1, 0, -1};
  hard.shadeSanely(frame);
  KernelConfig groove = hard.config();
  groove.groove = true;
  hard.shadeSanely(frame, groove);
}

void probabilityNearZeroAndOne(HardCase& hard) {
  HandMadeFrame frame = plainFrame(512);
  frame.material = simpleMaterial({0.5f, 0.5f}, {1e-4f, 1e-4f}, 1e10f);  // p = 4e-8 at its peak
  hard.expectReference(frame);
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.29999f, 0.29999f}, 1e6f);
  frame.lights = {coneLight({0.1, 0.2, 1})};
  frame.ray_origin = {0.1, 0.2, -1};  // p = 0.9999...
  hard.expectReference(frame);
}

void numberOfMicrodetailsFromNothingToABillion(HardCase& hard) {
  for (const float density : {1e-9f, 1e-3f, 1.f, 1e4f, 1e8f, 1e12f, 1e14f, 3e38f}) {
    HandMadeFrame frame = plainFrame(128);
    frame.material.glints.density = density;
    for (const float variation : {0.f, 100.f}) {
      frame.material.glints.size_variation = variation;
      hard.shadeSanely(frame);
    }
  }
}

void halfVectorAtTheHorizon(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights = {coneLight({1, 0, 1e-7}), coneLight({1, 0, 1e-3}), coneLight({0, 1, 0})};
  frame.ray_origin = {1, 0, -1e-7};
  hard.shadeSanely(frame);
}

void viewAlongTheNormal(HardCase& hard) {
  HandMadeFrame frame = plainFrame(256);
  frame.ray_origin = {0, 0, -1};
  frame.lights = {coneLight({0, 0, 1}), coneLight({0, 0, 1}, 0.1)};
  KernelConfig c = hard.config();
  c.light_cone = true;
  hard.shadeSanely(frame, c);
  frame.lights.pop_back();
  hard.expectReference(frame);
}

void viewFromBehindTheShadingNormal(HardCase& hard) {
  HandMadeFrame frame = plainFrame(16);
  frame.ray_origin = {0.3, 0.2, 1};
  hard.shadeSanely(frame);
}

void lightBelowTheHorizon(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights = {coneLight({0.3, 0.2, -0.9}), coneLight({1, 0, -1e-6})};
  hard.expectRadiance(hard.shadeSanely(frame), 0);
  for (const std::uint32_t cells : hard.shadeSanely(frame).cells)
    hard.finding.require(cells == 0, "a light below the horizon has cells");
}

void albedoZeroAndOne(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights = {coneLight({0, 0, 1})};
  frame.material.surface.intensity = 0;
  KernelConfig c = hard.config();
  c.diffuse = true;
  hard.expectRadiance(hard.shadeSanely(frame, c), 0);
  frame.material.surface.albedo = {1, 1, 1, 0};
  hard.expectRadiance(hard.shadeSanely(frame, c), std::numbers::inv_pi);
}

void noLights(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights.clear();
  hard.expectRadiance(hard.shadeSanely(frame), 0);
}

void manyLights(HardCase& hard) {
  HandMadeFrame frame = plainFrame(64);
  frame.lights.clear();
  for (int i = 0; i < 100; ++i)
    frame.lights.push_back(
        coneLight({std::cos(i * 0.7), std::sin(i * 0.7), 0.2 + 0.03 * i}, 0, 0.01));
  hard.expectReference(frame);
}

void litOnePixel(HardCase& hard) {
  for (const std::size_t count : {1u, 15u, 17u}) hard.expectReference(plainFrame(count));
}

constexpr NamedHardCase kSurfaceCases[] = {
    {"equal_roughness", microRoughnessEqualsGlobalRoughness, kFlippedPixelShare},
    {"roughness_zero", roughnessNearZero, 0},
    {"anisotropy_1000", roughnessOfOneAxisAThousandTimesTheOther, 0},
    {"probability_0_and_1", probabilityNearZeroAndOne, kFlippedPixelShare},
    {"count_0_to_1e9", numberOfMicrodetailsFromNothingToABillion, 0},
    {"half_vector_at_horizon", halfVectorAtTheHorizon, 0},
    {"view_along_normal", viewAlongTheNormal, kFlippedPixelShare},
    {"view_from_behind", viewFromBehindTheShadingNormal, 0},
    {"light_below_horizon", lightBelowTheHorizon, 0},
    {"albedo_0_and_1", albedoZeroAndOne, 0},
    {"no_lights", noLights, 0},
    {"many_lights", manyLights, 0.02},
    {"one_pixel", litOnePixel, kFlippedPixelShare},
};

}  // namespace

std::span<const NamedHardCase> hardSurfaces() {
  return kSurfaceCases;
}

}  // namespace glintmark
