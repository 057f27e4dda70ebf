// Lobes of normals: closed-form interpolation and shading against double precision.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "host/reference/normal_lobe.h"
#include "tests/glint/pixel_harness.h"
#include "tests/gmm/texture_harness.h"

namespace glintmark {
namespace {

/// Second moments near 1 in single precision.
constexpr double kVarianceTolerance = 4e-7;
constexpr double kMeanTolerance = 1e-6;
/// Relative: the rational fit of Smith's Lambda is good to 0.35 % of G1, here for light and view.
constexpr double kMaskingTolerance = 7e-3;
/// Relative, of cosines: some ten roundings.
constexpr double kCosineTolerance = 1e-5;
/// Brightness below which a difference does not show: the peak of the base lobe is above 1.
constexpr double kDark = 1e-4;

struct LobeCase {
  glm::vec4 moments;
  glm::vec3 light, view;
};

struct ProbedLobe {
  float weight, mean_x, mean_y, variance, specular, cosine;
};

std::vector<ProbedLobe> probe(const std::vector<LobeCase>& cases, float alpha, int width) {
  Device& device = KernelBench::shared().device;
  const std::size_t n = (cases.size() + 15) / 16 * 16;
  std::vector<float> in(10 * n), out(6 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const LobeCase& c = cases[std::min(i, cases.size() - 1)];
    const float values[] = {c.moments.x, c.moments.y, c.moments.z, c.moments.w, c.light.x,
                            c.light.y,   c.light.z,   c.view.x,    c.view.y,    c.view.z};
    for (std::size_t k = 0; k < 10; ++k) in[k * n + i] = values[k];
  }
  Buffer input(device, in.size() * 4, "lobes"), output(device, out.size() * 4, "shaded lobes");
  input.write(in.data(), in.size() * 4);
  const std::vector<KernelArg> args = {input, output, static_cast<std::uint32_t>(n), alpha};
  gmmProbeKernel("lobe_probe.cl", "probeLobe",
                 fmt::format("-D WIDTH={} -D DIFFUSE=1 -D NORMAL_MAP=1 -D NORMAL_METHOD=5 "
                             "-D LOBES=1",
                             width))
      .launch(args, n / static_cast<std::size_t>(width), 16);
  output.read(out.data(), out.size() * 4);
  std::vector<ProbedLobe> result;
  for (std::size_t i = 0; i < cases.size(); ++i)
    result.push_back(
        {out[i], out[n + i], out[2 * n + i], out[3 * n + i], out[4 * n + i], out[5 * n + i]});
  return result;
}

glm::vec4 momentsOf(float weight, glm::vec2 mean, float variance) {
  return {weight, weight * mean.x, weight * mean.y, weight * (2 * variance + glm::dot(mean, mean))};
}

glm::vec3 upward(std::mt19937& random, float most_tilt) {
  std::uniform_real_distribution<float> unit(0, 1);
  const float phi = 6.2831853f * unit(random), sine = most_tilt * std::sqrt(unit(random));
  return {sine * std::cos(phi), sine * std::sin(phi), std::sqrt(1 - sine * sine)};
}

std::vector<LobeCase> randomCases(std::size_t n) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<LobeCase> cases(n);
  for (LobeCase& c : cases) {
    const glm::vec3 m = upward(random, 0.95f);
    c.moments = momentsOf(unit(random), {m.x, m.y}, 0.1f * unit(random) * unit(random));
    c.light = upward(random, 0.98f);
    c.view = upward(random, 0.98f);
  }
  return cases;
}

TEST(Lobes, MatchTheReference) {
  const std::vector<LobeCase> cases = randomCases(2000);
  for (const float alpha : {0.05f, 0.25f, 0.8f}) {
    const auto probed = probe(cases, alpha, 16);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const reference::NormalLobe lobe = reference::lobeFromMoments(glm::dvec4(cases[i].moments));
      EXPECT_NEAR(probed[i].weight, lobe.weight, 1e-7);
      if (lobe.weight < 1e-3) continue;
      EXPECT_NEAR(probed[i].mean_x, lobe.mean.x, kMeanTolerance);
      EXPECT_NEAR(probed[i].mean_y, lobe.mean.y, kMeanTolerance);
      EXPECT_NEAR(probed[i].variance, lobe.variance, kVarianceTolerance);
      // What is shaded is the lobe the kernel found; its own rounding is tested above.
      const reference::NormalLobe found = {
          probed[i].weight, {probed[i].mean_x, probed[i].mean_y}, probed[i].variance};
      const reference::LobeLight expected =
          reference::shadeLobe(found, glm::dvec3(cases[i].light), glm::dvec3(cases[i].view), alpha);
      EXPECT_NEAR(probed[i].specular, expected.specular,
                  kMaskingTolerance * expected.specular + kDark)
          << "case " << i << ", alpha " << alpha;
      EXPECT_NEAR(probed[i].cosine, expected.cosine, kCosineTolerance) << "case " << i;
    }
  }
}

TEST(Lobes, EveryWidthGivesTheSameBits) {
  const std::vector<LobeCase> cases = randomCases(300);
  const auto one = probe(cases, 0.2f, 1);
  for (const int width : {4, 8, 16}) {
    const auto wide = probe(cases, 0.2f, width);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(one[i].specular),
                std::bit_cast<std::uint32_t>(wide[i].specular))
          << width;
      EXPECT_EQ(std::bit_cast<std::uint32_t>(one[i].cosine),
                std::bit_cast<std::uint32_t>(wide[i].cosine))
          << width;
    }
  }
}

TEST(Lobes, HardCasesStayFiniteAndNotNegative) {
  std::vector<LobeCase> cases;
  const glm::vec3 up(0, 0, 1), grazing = glm::normalize(glm::vec3(1, 0, 1e-4f));
  const glm::vec3 below = glm::normalize(glm::vec3(0, 1, -0.3f));
  for (const glm::vec3& light : {up, grazing, below})
    for (const glm::vec3& view : {up, grazing, glm::vec3(-grazing.x, 0, grazing.z)})
      for (const glm::vec4& moments :
           {momentsOf(0, {0, 0}, 0), momentsOf(1, {0, 0}, 0), momentsOf(1e-9f, {0.5f, 0}, 0.1f),
            momentsOf(1, {0.999f, 0}, 0), momentsOf(1, {1, 0}, 0.5f), momentsOf(0.5f, {0, 0}, 1),
            glm::vec4(1, 0.6f, 0, 0.3f), glm::vec4(-1e-8f, 0, 0, 0), glm::vec4(1, 2, 2, 0)})
        cases.push_back({moments, light, view});
  for (const float alpha : {1e-3f, 0.2f, 1.0f})
    for (const ProbedLobe& lobe : probe(cases, alpha, 16))
      for (const float value : {lobe.weight, lobe.variance, lobe.specular, lobe.cosine})
        EXPECT_TRUE(std::isfinite(value) && value >= 0) << value;
}

// Four lobes in, what is left of them out: one pixel per group of sixteen lanes.
struct Mixture {
  int used = 0;
  glm::vec4 lobes[4];  // weight, mean x, mean y, variance
};

Mixture probeMixture(const std::vector<glm::vec4>& moments, float alpha) {
  constexpr std::size_t kLanes = 16;
  std::vector<float> in(16 * kLanes), out(17 * kLanes);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t lane = 0; lane < kLanes; ++lane)
        in[(4 * k + c) * kLanes + lane] = moments[k][static_cast<int>(c)];
  Device& device = KernelBench::shared().device;
  Buffer input(device, in.size() * 4, "moments"), output(device, out.size() * 4, "a mixture");
  input.write(in.data(), in.size() * 4);
  const std::vector<KernelArg> args = {input, output, static_cast<std::uint32_t>(kLanes), alpha};
  gmmProbeKernel("lobe_probe.cl", "probeMixture",
                 "-D WIDTH=16 -D DIFFUSE=1 -D NORMAL_MAP=1 -D NORMAL_METHOD=5 -D LOBES=4")
      .launch(args, 1, 1);
  output.read(out.data(), out.size() * 4);
  Mixture mixture;
  mixture.used = static_cast<int>(out[0]);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 4; ++c)
      mixture.lobes[k][static_cast<int>(c)] = out[(4 * k + c + 1) * kLanes];
  return mixture;
}

TEST(Mixtures, CloseLobesBecomeOneOfTheSameMeanAndVariance) {
  const glm::vec2 means[] = {{0.11f, 0.2f}, {0.1f, 0.21f}, {0.09f, 0.19f}, {0.1f, 0.2f}};
  const float weights[] = {0.4f, 0.3f, 0.2f, 0.1f}, variances[] = {1e-4f, 0, 2e-4f, 1e-4f};
  std::vector<glm::vec4> moments;
  glm::dvec4 sum(0);
  for (int i = 0; i < 4; ++i) {
    moments.push_back(momentsOf(weights[i], means[i], variances[i]));
    sum += glm::dvec4(moments.back());
  }
  const Mixture merged = probeMixture(moments, 0.25f);
  const reference::NormalLobe pooled = reference::lobeFromMoments(sum);
  EXPECT_EQ(merged.used, 1);
  EXPECT_NEAR(merged.lobes[0][0], 1, kMeanTolerance);
  EXPECT_NEAR(merged.lobes[0][1], pooled.mean.x, kMeanTolerance);
  EXPECT_NEAR(merged.lobes[0][2], pooled.mean.y, kMeanTolerance);
  EXPECT_NEAR(merged.lobes[0][3], pooled.variance, kVarianceTolerance);
  EXPECT_EQ(probeMixture(moments, 0.02f).used, 4) << "a smooth base lobe shows them apart";
}

TEST(Mixtures, LobesOfWeightZeroGoLastAndTheOthersKeepTheirOrder) {
  const Mixture packed = probeMixture({momentsOf(0, {0, 0}, 0), momentsOf(0.7f, {0.5f, 0}, 0.01f),
                                       momentsOf(0, {0, 0}, 0), momentsOf(0.3f, {-0.5f, 0.1f}, 0)},
                                      0.1f);
  EXPECT_EQ(packed.used, 2);
  EXPECT_FLOAT_EQ(packed.lobes[0][0], 0.7f);
  EXPECT_FLOAT_EQ(packed.lobes[1][0], 0.3f);
  EXPECT_NEAR(packed.lobes[1][1], -0.5f, kMeanTolerance);
  EXPECT_EQ(probeMixture(std::vector<glm::vec4>(4, glm::vec4(0)), 0.1f).used, 1) << "no lobe";
}

}  // namespace
}  // namespace glintmark
