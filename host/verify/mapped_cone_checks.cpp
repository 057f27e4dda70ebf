// Lobes of mapped normals that are spread, under cones: brute force over the cone of what the same
// lobe is under a point, with Schlick's term at the half vector of each direction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/core/angles.h"
#include "host/frame/effect/lights.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/tolerances.h"
#include "host/reference/normal_lobe.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kDirections = 20000;
constexpr int kCases = 24;

struct SpreadCone {
  glm::dvec3 axis, view, normal;  // mesh tangent space
};

// Views of all heights, lights near where the lobe mirrors the view.
std::vector<SpreadCone> spreadCones(double alpha, double half_rad) {
  std::mt19937 random(31);
  const auto unit = [&] { return std::uniform_real_distribution<double>()(random); };
  std::vector<SpreadCone> cases;
  while (cases.size() < kCases) {
    SpreadCone c;
    const double z = 0.2 + 0.8 * unit(), turn = 2 * kPi * unit(), r = std::sqrt(1 - z * z);
    c.view = {r * std::cos(turn), r * std::sin(turn), z};
    c.normal = glm::normalize(glm::dvec3(0.5 * (unit() - 0.5), 0.5 * (unit() - 0.5), 1));
    const glm::dvec3 off(alpha * (unit() - 0.5), alpha * (unit() - 0.5), 0);
    const glm::dvec3 m = glm::normalize(c.normal + off);
    c.axis = 2 * glm::dot(c.view, m) * m - c.view;
    // Whole cones: what the horizon cuts is asked for elsewhere.
    if (glm::dot(c.axis, c.normal) < std::sin(half_rad) + 0.1 || c.axis.z < 0.1 ||
        glm::dot(c.view, c.normal) < 0.15)
      continue;
    for (glm::dvec3* v : {&c.axis, &c.view, &c.normal})
      *v = glm::normalize(glm::dvec3(glm::vec3(*v)));
    cases.push_back(c);
  }
  return cases;
}

struct Spread {
  double specular = 0, schlick = 0, cosine = 0;
};

// The mean over the cone.
Spread bruteForce(const SpreadCone& c, double half_rad, double alpha, double variance) {
  const reference::NormalLobe lobe = {1, {c.normal.x, c.normal.y}, variance};
  const glm::dvec3 t = glm::normalize(
      glm::cross(std::abs(c.axis.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), c.axis));
  const glm::dvec3 b = glm::cross(c.axis, t);
  Spread sum;
  for (int k = 0; k < kDirections; ++k) {
    const double height = (1 - std::cos(half_rad)) * (k + 0.5) / kDirections;
    const double phi = 2 * kPi * std::fmod(k * 0.6180339887498949, 1.0);
    const double radius = std::sqrt(height * (2 - height));
    const glm::dvec3 i = (1 - height) * c.axis + radius * (std::cos(phi) * t + std::sin(phi) * b);
    const reference::LobeLight shaded = reference::shadeLobe(lobe, i, c.view, alpha);
    const double value = shaded.specular;
    sum.specular += value / kDirections;
    sum.cosine += shaded.cosine / kDirections;
    sum.schlick +=
        value / kDirections * std::pow(1 - glm::dot(c.view, glm::normalize(i + c.view)), 5);
  }
  return sum;
}

Finding spread(const CheckContext& context, double half_deg) {
  const double half_rad = half_deg * kDegree;
  Finding finding(kNarrowConeTolerance);
  for (const auto& [alpha, variance] : {std::pair{0.1, 0.005}, {0.2, 0.05}, {0.3, 0.02}}) {
    const std::vector<SpreadCone> cases = spreadCones(alpha, half_rad);
    const std::size_t n = paddedCount(cases.size());
    std::vector<float> in(9 * n), out(3 * n);
    for (std::size_t i = 0; i < n; ++i) {
      const SpreadCone& c = cases[std::min(i, cases.size() - 1)];
      const glm::dvec3 vectors[] = {c.axis, c.view, c.normal};
      for (std::size_t k = 0; k < 9; ++k)
        in[k * n + i] = static_cast<float>(vectors[k / 3][static_cast<int>(k % 3)]);
    }
    Buffer output(context.bench.device, out.size() * 4, BufferPurpose::kProbe, "spread lobes");
    const std::vector<ConeLight> light = {coneLight({0, 0, 1}, half_rad)};
    const std::vector<KernelArg> args = {
        probeData(context.bench, in),  output,
        static_cast<std::uint32_t>(n), probeData(context.bench, prepareLights(light)),
        static_cast<float>(alpha),     static_cast<float>(variance)};
    probeKernel(context.bench, "probes/probe_mapped_cone.cl", "probeMappedCone",
                fmt::format("-D WIDTH={} -D LIGHT_CONE=1 -D NORMAL_MAP=1 -D LOBES=1 -D DIFFUSE=1",
                            context.lanes))
        .launch(args, n / static_cast<std::size_t>(context.lanes), kLocalSize);
    output.read(out.data(), out.size() * 4);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Spread want = bruteForce(cases[i], half_rad, alpha, variance);
      finding.add(std::abs(out[i] / want.specular - 1));
      finding.add(std::abs(out[2 * n + i] - want.cosine));
      finding.add(std::abs(out[n + i] - want.schlick) /
                  std::max(want.schlick, kDarkSchlick * want.specular));
    }
  }
  return finding;
}

}  // namespace

std::vector<Check> mappedConeChecks() {
  std::vector<Check> checks;
  for (const double half_deg : {1.0, 5.0, 20.0, 40.0})
    checks.push_back(
        {fmt::format("cone/{}deg_spread_normals", half_deg), "relative error",
         [half_deg](const CheckContext& context) { return spread(context, half_deg); }});
  return checks;
}

}  // namespace glintmark
