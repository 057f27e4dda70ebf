// Lobes of normals: closed-form interpolation and shading against double precision.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

#include "host/harness/pixel_harness.h"
#include "host/harness/tolerances.h"
#include "host/reference/normal_lobe.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

struct LobeCase {
  glm::vec4 moments;
  glm::vec3 light, view;
};

struct ProbedLobe {
  float weight, mean_x, mean_y, variance, specular, cosine;
};

std::vector<ProbedLobe> probeLobes(const CheckContext& context, const std::vector<LobeCase>& cases,
                                   float alpha) {
  const std::size_t n = paddedCount(cases.size());
  std::vector<float> in(10 * n), out(6 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const LobeCase& c = cases[std::min(i, cases.size() - 1)];
    const float values[] = {c.moments.x, c.moments.y, c.moments.z, c.moments.w, c.light.x,
                            c.light.y,   c.light.z,   c.view.x,    c.view.y,    c.view.z};
    for (std::size_t k = 0; k < 10; ++k) in[k * n + i] = values[k];
  }
  Buffer output(context.bench.device, out.size() * 4, BufferPurpose::kProbe, "shaded lobes");
  const std::vector<KernelArg> args = {probeData(context.bench, in, "lobes"), output,
                                       static_cast<std::uint32_t>(n), alpha};
  probeKernel(context.bench, "probes/probe_lobe.cl", "probeLobe",
              fmt::format("-D WIDTH={} -D DIFFUSE=1 -D NORMAL_MAP=1 -D LOBES=1", context.lanes))
      .launch(args, n / static_cast<std::size_t>(context.lanes), kLocalSize);
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

std::vector<LobeCase> randomLobes(std::size_t n) {
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

// Every quantity in units of its own bound.
Finding lobesMatchReference(const CheckContext& context) {
  const std::vector<LobeCase> cases = randomLobes(2000);
  Finding finding(1);
  for (const float alpha : {0.05f, 0.25f, 0.8f}) {
    const auto probed = probeLobes(context, cases, alpha);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const ProbedLobe& p = probed[i];
      const reference::NormalLobe lobe = reference::lobeFromMoments(glm::dvec4(cases[i].moments));
      finding.add(std::abs(p.weight - lobe.weight) / kLobeWeight);
      if (lobe.weight < 1e-3) continue;
      finding.add(std::abs(p.mean_x - lobe.mean.x) / kLobeMean);
      finding.add(std::abs(p.mean_y - lobe.mean.y) / kLobeMean);
      finding.add(std::abs(p.variance - lobe.variance) / kLobeVariance);
      const reference::LobeLight expected =
          reference::shadeLobe(lobe, glm::dvec3(cases[i].light), glm::dvec3(cases[i].view), alpha);
      const double of_mass = reference::massOnDisk(lobe) < 1 - 1e-4 ? kDiskMass : 0;
      finding.add(std::abs(p.specular - expected.specular) /
                  ((kMaskingTolerance + of_mass) * expected.specular + kDark));
      finding.add(std::abs(p.cosine - expected.cosine) / kLobeCosine);
    }
  }
  return finding;
}

Finding sameLobes(const CheckContext& context) {
  const std::vector<LobeCase> cases = randomLobes(300);
  const auto one = probeLobes(context.withLanes(1), cases, 0.2f),
             wide = probeLobes(context, cases, 0.2f);
  const auto differ = [](float a, float b) {
    return std::bit_cast<std::uint32_t>(a) != std::bit_cast<std::uint32_t>(b);
  };
  double different = 0;
  for (std::size_t i = 0; i < cases.size(); ++i)
    different += differ(one[i].specular, wide[i].specular) || differ(one[i].cosine, wide[i].cosine);
  Finding finding(0);
  finding.add(different);
  return finding;
}

// Weight 0, variance 0 and 1, means on the horizon and beyond, moments that no distribution has;
// light and view straight up, grazing and below.
Finding hardLobes(const CheckContext& context) {
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
  double bad = 0;
  for (const float alpha : {1e-3f, 0.2f, 1.0f})
    for (const ProbedLobe& lobe : probeLobes(context, cases, alpha))
      for (const float value : {lobe.weight, lobe.variance, lobe.specular, lobe.cosine})
        bad += !(std::isfinite(value) && value >= 0);
  Finding finding(0);
  finding.add(bad);
  return finding;
}

// Four lobes in, what is left of them out: one pixel in all lanes.
struct Mixture {
  int used = 0;
  glm::vec4 lobes[4];  // weight, mean x, mean y, variance
};

Mixture probeMixture(const CheckContext& context, const std::vector<glm::vec4>& moments,
                     float alpha, float true_spread = 1) {
  const auto lanes = static_cast<std::size_t>(context.lanes);
  std::vector<float> in(16 * lanes), out(17 * lanes);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 4; ++c)
      for (std::size_t lane = 0; lane < lanes; ++lane)
        in[(4 * k + c) * lanes + lane] = moments[k][static_cast<int>(c)];
  Buffer output(context.bench.device, out.size() * 4, BufferPurpose::kProbe, "a mixture");
  const std::vector<KernelArg> args = {probeData(context.bench, in, "moments"), output,
                                       static_cast<std::uint32_t>(lanes), alpha, true_spread};
  probeKernel(context.bench, "probes/probe_lobe.cl", "probeMixture",
              fmt::format("-D WIDTH={} -D DIFFUSE=1 -D NORMAL_MAP=1 -D LOBES=4", lanes))
      .launch(args, 1, 1);
  output.read(out.data(), out.size() * 4);
  Mixture mixture;
  mixture.used = static_cast<int>(out[0]);
  for (std::size_t k = 0; k < 4; ++k)
    for (std::size_t c = 0; c < 4; ++c)
      mixture.lobes[k][static_cast<int>(c)] = out[(4 * k + c + 1) * lanes];
  return mixture;
}

// Four lobes that a base lobe of roughness 0.25 hides from each other become one of the same mean
// and variance; a smooth base lobe shows them apart. Quantities in units of their own bounds.
Finding closeLobesMerge(const CheckContext& context) {
  const glm::vec2 means[] = {{0.11f, 0.2f}, {0.1f, 0.21f}, {0.09f, 0.19f}, {0.1f, 0.2f}};
  const float weights[] = {0.4f, 0.3f, 0.2f, 0.1f}, variances[] = {1e-4f, 0, 2e-4f, 1e-4f};
  std::vector<glm::vec4> moments;
  glm::dvec4 sum(0);
  for (int i = 0; i < 4; ++i) {
    moments.push_back(momentsOf(weights[i], means[i], variances[i]));
    sum += glm::dvec4(moments.back());
  }
  const Mixture merged = probeMixture(context, moments, 0.25f);
  const reference::NormalLobe pooled = reference::lobeFromMoments(sum);
  Finding finding(1);
  finding.require(merged.used == 1, "close lobes are still several");
  finding.add(std::abs(merged.lobes[0][0] - 1) / kLobeMean);
  finding.add(std::abs(merged.lobes[0][1] - pooled.mean.x) / kLobeMean);
  finding.add(std::abs(merged.lobes[0][2] - pooled.mean.y) / kLobeMean);
  finding.add(std::abs(merged.lobes[0][3] - pooled.variance) / kLobeVariance);
  finding.require(probeMixture(context, moments, 0.02f).used == 4,
                  "lobes that a smooth base lobe shows apart became fewer");
  return finding;
}

// What is shaded of mixtures of any spread is what all of their lobes together are: lobes become
// one only where the base lobe hides them. Relative to the brightest of a mixture's directions.
Finding mergingIsHidden(const CheckContext& context) {
  Finding finding(kMergedLobes);
  std::mt19937 random(17);
  const auto unit = [&] { return std::uniform_real_distribution<double>()(random); };
  int merged = 0, kept = 0;
  for (int k = 0; k < 60; ++k) {
    const double alpha = 0.1 + 0.3 * unit(), spread = alpha * std::pow(10.0, -1.5 + 1.5 * unit());
    const glm::vec2 centre(0.6 * (unit() - 0.5), 0.6 * (unit() - 0.5));
    std::vector<glm::vec4> moments;
    for (int i = 0; i < 4; ++i) {
      const glm::vec2 off(static_cast<float>(spread * (unit() - 0.5)),
                          static_cast<float>(spread * (unit() - 0.5)));
      moments.push_back(
          momentsOf(0.25f, centre + off, static_cast<float>(0.05 * spread * spread * unit())));
    }
    const Mixture shown = probeMixture(context, moments, static_cast<float>(alpha));
    merged += shown.used == 1;
    kept += shown.used == 4;
    const glm::dvec3 view(0.3, -0.2, std::sqrt(1 - 0.13));
    std::vector<double> got, want;
    for (int d = 0; d < 200; ++d) {
      const glm::dvec3 m = glm::normalize(
          glm::dvec3(glm::dvec2(centre) + 3 * alpha * glm::dvec2(unit() - 0.5, unit() - 0.5), 1));
      const glm::dvec3 light = 2 * glm::dot(view, m) * m - view;
      if (light.z < 0.1) continue;
      double all = 0, some = 0;
      for (int i = 0; i < 4; ++i) {
        const glm::vec4& l = shown.lobes[i];
        all += reference::shadeLobe(
                   reference::lobeFromMoments(glm::dvec4(moments[static_cast<std::size_t>(i)])),
                   light, view, alpha)
                   .specular;
        if (i < shown.used)
          some += reference::shadeLobe({l[0], {l[1], l[2]}, l[3]}, light, view, alpha).specular;
      }
      got.push_back(some);
      want.push_back(all);
    }
    const double brightest = *std::max_element(want.begin(), want.end());
    for (std::size_t d = 0; d < got.size(); ++d)
      finding.add(std::abs(got[d] - want[d]) / brightest);
  }
  finding.require(merged > 10 && kept > 10, "too few mixtures become one lobe, or stay four");
  return finding;
}

// Smaller than the finest texels, a footprint shows of its lobes' variance the share that lies
// under it: means move towards their own by its root.
Finding magnifiedLobes(const CheckContext& context) {
  const glm::vec2 means[] = {{0.3f, 0.2f}, {-0.2f, 0.3f}, {0.1f, -0.4f}, {0.4f, -0.1f}};
  const float weights[] = {0.4f, 0.3f, 0.2f, 0.1f}, variances[] = {0.01f, 0.02f, 0, 0.03f};
  std::vector<glm::vec4> moments;
  glm::dvec2 centre(0);
  for (int i = 0; i < 4; ++i) {
    moments.push_back(momentsOf(weights[i], means[i], variances[i]));
    centre += static_cast<double>(weights[i]) * glm::dvec2(means[i]);
  }
  Finding finding(1);
  for (const double share : {1.0, 0.6, 0.05}) {
    const Mixture shown = probeMixture(context, moments, 0.01f, static_cast<float>(share));
    finding.require(shown.used == 4, "four lobes became fewer");
    for (int i = 0; i < 4; ++i) {
      const glm::dvec2 want = centre + std::sqrt(share) * (glm::dvec2(means[i]) - centre);
      finding.add(std::abs(shown.lobes[i][0] - weights[i]) / kLobeMean);
      finding.add(std::abs(shown.lobes[i][1] - want.x) / kLobeMean);
      finding.add(std::abs(shown.lobes[i][2] - want.y) / kLobeMean);
      finding.add(std::abs(shown.lobes[i][3] - share * variances[i]) / kLobeVariance);
    }
  }
  return finding;
}

Finding weightlessLobesGoLast(const CheckContext& context) {
  const Mixture packed = probeMixture(context,
                                      {momentsOf(0, {0, 0}, 0), momentsOf(0.7f, {0.5f, 0}, 0.01f),
                                       momentsOf(0, {0, 0}, 0), momentsOf(0.3f, {-0.5f, 0.1f}, 0)},
                                      0.1f);
  Finding finding(1);
  finding.require(packed.used == 2, "two of four lobes have weight");
  finding.add(std::abs(packed.lobes[0][0] - 0.7f) / kLobeWeight);
  finding.add(std::abs(packed.lobes[1][0] - 0.3f) / kLobeWeight);
  finding.add(std::abs(packed.lobes[1][1] + 0.5f) / kLobeMean);
  finding.require(probeMixture(context, std::vector<glm::vec4>(4, glm::vec4(0)), 0.1f).used == 1,
                  "no lobe of weight is shaded as one");
  return finding;
}

}  // namespace

std::vector<Check> lobeChecks() {
  return {{"lobe/reference", "error in units of its bound", lobesMatchReference},
          {"lobe/weight_0_variance_0", "values NaN, infinite or negative", hardLobes},
          {"lobe/close_lobes_merge", "error in units of its bound", closeLobesMerge},
          {"lobe/merging_is_hidden", "error over the brightest", mergingIsHidden},
          {"lobe/magnified", "error in units of its bound", magnifiedLobes},
          {"lobe/weight_0_last", "error in units of its bound", weightlessLobesGoLast},
          {"lobe/same_bits", "lobes that differ from one lane's", sameLobes}};
}

}  // namespace glintmark
