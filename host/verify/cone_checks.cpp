// Lights of any width: the smooth lobe, the share of microdetails that reflect and the diffuse term
// against brute force over the cone, from 0.1 degrees above the surface to the zenith.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>

#include "host/core/angles.h"
#include "host/frame/effect/lights.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/tolerances.h"
#include "host/reference/light_cone.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kConeSamples = 8000;
constexpr double kViews_deg[] = {0.1, 0.5, 1, 3, 10, 30, 60, 90};  // above the surface
constexpr glm::dvec2 kRoughness[] = {{0.01, 0.01}, {0.03, 0.03}, {0.1, 0.1},  {0.3, 0.3},
                                     {0.5, 0.15},  {0.6, 0.6},   {0.05, 0.5}, {1, 1}};
constexpr int kPerRoughness = 8;  // cases of each check
// What interpolated normals leave of views at silhouettes; rare lights are what goes wrong there.
constexpr double kSilhouettes_deg[] = {0.0058, 0.01, 0.03, 0.1};
constexpr int kSilhouettesPerRoughness = 128, kSilhouetteSamples = 1000;

glm::dvec3 raised(double elevation_rad, double turn_rad) {
  return {std::cos(elevation_rad) * std::cos(turn_rad),
          std::cos(elevation_rad) * std::sin(turn_rad), std::sin(elevation_rad)};
}

struct ConeCase {
  glm::dvec3 axis, view;
};

struct ProbedCone {
  double specular, cosine, probability, cell_side;
};

// Lobes under one light and material, for many directions of both light and view. Directions are
// rounded to single precision, as the kernel sees them.
std::vector<ProbedCone> probeCones(const CheckContext& context, std::vector<ConeCase>& cases,
                                   const MaterialParams& material, double half_rad, bool groove) {
  const std::size_t n = paddedCount(cases.size());
  std::vector<float> in(6 * n), out(5 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const ConeCase& c = cases[std::min(i, cases.size() - 1)];
    for (int k = 0; k < 3; ++k) {
      in[static_cast<std::size_t>(k) * n + i] = static_cast<float>(c.axis[k]);
      in[static_cast<std::size_t>(k + 3) * n + i] = static_cast<float>(c.view[k]);
    }
  }
  for (std::size_t i = 0; i < cases.size(); ++i) {
    cases[i].axis = glm::normalize(glm::dvec3(in[i], in[n + i], in[2 * n + i]));
    cases[i].view = glm::normalize(glm::dvec3(in[3 * n + i], in[4 * n + i], in[5 * n + i]));
  }
  Device& device = context.bench.device;
  Buffer output(device, out.size() * 4, BufferPurpose::kProbe, "lobes under cones");
  const std::vector<ConeLight> light = {coneLight({0, 0, 1}, half_rad)};
  const std::vector<KernelArg> args = {probeData(context.bench, in), output,
                                       static_cast<std::uint32_t>(n),
                                       probeData(context.bench, std::vector{material}),
                                       probeData(context.bench, prepareLights(light))};
  probeKernel(
      context.bench, "probes/probe_cone.cl", "probeCone",
      fmt::format("-D WIDTH={} -D LIGHT_CONE=1 -D GROOVE={}", context.lanes, groove ? 1 : 0))
      .launch(args, n / static_cast<std::size_t>(context.lanes), kLocalSize);
  output.read(out.data(), out.size() * 4);
  std::vector<ProbedCone> result;
  for (std::size_t i = 0; i < cases.size(); ++i)
    result.push_back({out[i], out[2 * n + i], out[3 * n + i], out[4 * n + i]});
  return result;
}

// Every other light mirrors a slope of the lobe into the eye, the rest stand anywhere.
std::vector<ConeCase> randomCones(const glm::dvec2& alpha, double half_rad, unsigned seed,
                                  std::span<const double> views_deg = kViews_deg,
                                  int count = kPerRoughness) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi), unit(0, 1);
  std::normal_distribution<double> normal(0, 0.8);
  std::vector<ConeCase> cases(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    ConeCase& c = cases[i];
    c.view = raised(views_deg[(i + seed) % views_deg.size()] * kDegree, turn(random));
    const glm::dvec3 m =
        glm::normalize(glm::dvec3(alpha.x * normal(random), alpha.y * normal(random), 1));
    const double lowest = -std::min(half_rad, 1.0);
    c.axis = i % 2 == 0
                 ? 2 * glm::dot(c.view, m) * m - c.view
                 : raised(lowest + (0.5 * std::numbers::pi - lowest) * unit(random), turn(random));
  }
  return cases;
}

// The brightest that a light of this size brings to the view, near the mirrored direction.
double brightest(const ConeCase& c, double half_rad, const glm::dvec2& alpha,
                 int samples = kConeSamples / 10) {
  const double azimuth = std::atan2(-c.view.y, -c.view.x),
               elevation = std::asin(std::min(c.view.z, 1.0));
  double most = 0;
  for (const double higher_deg : {0.0, 1.0, 3.0, 10.0, 20.0}) {
    const double angle = std::min(elevation + higher_deg * kDegree, 0.5 * std::numbers::pi);
    const reference::Cone light = {raised(angle, azimuth), half_rad};
    most = std::max(most, reference::coneRadiance(light, c.view, alpha, glm::dvec3(1), samples).x);
  }
  return most;
}

MaterialParams materialOf(const glm::dvec2& alpha, double micro) {
  return simpleMaterial({static_cast<float>(alpha.x), static_cast<float>(alpha.y)},
                        {static_cast<float>(micro * alpha.x), static_cast<float>(micro * alpha.y)},
                        1e6f);
}

struct ConeKind {
  double half_deg;
  bool groove;
};

// The lobe of these cases, relative to the true value or the brightest of its view.
void addLobes(const CheckContext& context, std::vector<ConeCase>& cases, const glm::dvec2& alpha,
              ConeKind kind, Finding& finding) {
  const double half_rad = kind.half_deg * kDegree, power = 2 / (1 + std::cos(half_rad));
  const auto probed = probeCones(context, cases, materialOf(alpha, 0.3), half_rad, kind.groove);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const ConeCase& c = cases[i];
    const double want =
        reference::coneRadiance({c.axis, half_rad}, c.view, alpha, glm::dvec3(1), kConeSamples).x;
    const double most = std::max(brightest(c, half_rad, alpha), want);
    finding.add(std::abs(probed[i].specular * power - want) / std::max(most, 1e-30));
  }
}

// The lobe at any view.
Finding lobe(const CheckContext& context, ConeKind kind) {
  const double half_rad = kind.half_deg * kDegree;
  Finding finding(kind.half_deg <= kConeNarrow_deg ? kNarrowConeTolerance : kWideConeTolerance);
  unsigned seed = 0;
  for (const glm::dvec2& alpha : kRoughness) {
    std::vector<ConeCase> cases = randomCones(alpha, half_rad, ++seed);
    addLobes(context, cases, alpha, kind, finding);
  }
  return finding;
}

// The lobe under lights that stand exactly on the normal, above and below the surface, as one light
// over a flat floor stands for every pixel.
Finding onTheNormal(const CheckContext& context, double half_deg) {
  Finding finding(half_deg <= kConeNarrow_deg ? kNarrowConeTolerance : kWideConeTolerance);
  for (const glm::dvec2& alpha : kRoughness) {
    std::vector<ConeCase> cases;
    for (const double side : {1.0, -1.0}) {
      for (const double view_deg : kViews_deg)
        cases.push_back({{0, 0, side}, raised(view_deg * kDegree, 0.7)});
      cases.push_back({{0, 0, side}, {0, 0, 1}});
    }
    addLobes(context, cases, alpha, {half_deg, false}, finding);
  }
  return finding;
}

// The lobe at silhouettes, under lights near the mirrored view and lights that the horizon cuts:
// none that should be dark glows.
Finding silhouettes(const CheckContext& context, double half_deg) {
  const double half_rad = half_deg * kDegree, power = 2 / (1 + std::cos(half_rad));
  Finding finding(kSilhouetteCone);
  unsigned seed = 300;
  for (const glm::dvec2& alpha : kRoughness) {
    std::vector<ConeCase> cases =
        randomCones(alpha, half_rad, ++seed, kSilhouettes_deg, kSilhouettesPerRoughness);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi), below(-half_rad, 0);
    for (std::size_t i = 1; i < cases.size(); i += 2)
      cases[i].axis = raised(below(random), turn(random));
    const auto probed = probeCones(context, cases, materialOf(alpha, 0.3), half_rad, false);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const ConeCase& c = cases[i];
      const double want = reference::coneRadiance({c.axis, half_rad}, c.view, alpha, glm::dvec3(1),
                                                  kSilhouetteSamples)
                              .x;
      const double most = std::max(brightest(c, half_rad, alpha, kSilhouetteSamples / 5), want);
      finding.add(std::abs(probed[i].specular * power - want) / std::max(most, 1e-30));
    }
  }
  return finding;
}

// The share of reflecting microdetails, where it is at all likely: what nine of ten lights above
// the horizon stay below. Where the horizon cuts a cone only the magnitude is asked for.
Finding probability(const CheckContext& context, ConeKind kind) {
  const double half_rad = kind.half_deg * kDegree;
  Finding finding(kind.half_deg <= 20 ? kConeProbability
                  : kind.groove       ? kWideGrooveProbability
                                      : kWideConeProbability);
  std::vector<double> errors;
  unsigned seed = 100;
  for (const glm::dvec2& alpha : kRoughness)
    for (const double micro : {0.15, 0.5, 0.9}) {
      if (micro * std::min(alpha.x, alpha.y) < 0.01) continue;
      std::vector<ConeCase> cases = randomCones(alpha, half_rad, ++seed);
      const auto probed =
          probeCones(context, cases, materialOf(alpha, micro), half_rad, kind.groove);
      for (std::size_t i = 0; i < cases.size(); ++i) {
        const ConeCase& c = cases[i];
        // The horizon cuts every hemisphere of light but that of the zenith.
        const bool whole = std::asin(c.axis.z) >= (kind.half_deg < 90 ? half_rad : 0);
        // Grooves mirror nothing far along them, and a share of nothing is not asked for.
        const glm::dvec3 sum = c.axis + c.view;
        if (kind.groove && (!whole || std::abs(sum.x) > 3 * alpha.x * sum.z)) continue;
        const double want = reference::coneProbability({c.axis, half_rad}, c.view, alpha,
                                                       micro * alpha, kind.groove, kConeSamples);
        if (want < 0.02) continue;
        const double ratio = probed[i].probability / want;
        finding.require(ratio > 1 / kProbabilityMagnitude && ratio < kProbabilityMagnitude,
                        fmt::format("a light at {:.1f} degrees has {:.2g} times its share",
                                    std::asin(c.axis.z) / kDegree, ratio));
        if (whole) errors.push_back(std::abs(ratio - 1));
      }
    }
  finding.addMost(errors, 0);
  return finding;
}

// Cones that are points to the surface and none to a microdetail, seen and lit along the normal and
// at a slant along either axis: every one.
Finding narrowProbability(const CheckContext& context) {
  Finding finding(kConeProbability);
  for (const double half_deg : {0.3, 1.0, 2.0}) {
    const double half_rad = half_deg * kDegree;
    const glm::dvec2 alpha(0.5, 0.4);
    std::vector<ConeCase> cases;
    for (const double slant_deg : {0.0, 30.0, 55.0})
      for (const double turn : {0.0, 0.5, 1.0}) {
        const double azimuth = turn * std::numbers::pi;
        const glm::dvec3 view = raised((90 - slant_deg) * kDegree, azimuth);
        const glm::dvec3 m = glm::normalize(glm::dvec3(0.1, -0.05, 1));
        cases.push_back({2 * glm::dot(view, m) * m - view, view});
      }
    // A quarter and two thirds of the cone's slopes, for which ellipses have masses; and twice as
    // much, for which a series does.
    for (const double micro : {0.3 * half_rad, 0.8 * half_rad, 1.6 * half_rad}) {
      const auto probed = probeCones(context, cases, materialOf(alpha, micro), half_rad, false);
      for (std::size_t i = 0; i < cases.size(); ++i) {
        const double want = reference::coneProbability({cases[i].axis, half_rad}, cases[i].view,
                                                       alpha, micro * alpha, false, kConeSamples);
        finding.add(std::abs(probed[i].probability / want - 1));
      }
    }
  }
  return finding;
}

// A lobe of mapped normals whose mean is tilted, against brute force over the cone of the same lobe
// under points (variance 0: of the smooth lobe in the normal's frame).
Finding mapped(const CheckContext& context, double half_deg) {
  const double half_rad = half_deg * kDegree, power = 2 / (1 + std::cos(half_rad));
  Finding finding(half_deg <= kConeNarrow_deg ? kNarrowConeTolerance : kWideConeTolerance);
  const glm::dvec3 n = glm::normalize(glm::dvec3(0.3, -0.2, 1));
  const glm::dvec3 t = glm::normalize(glm::dvec3(n.z, 0, -n.x)), b = glm::cross(n, t);
  const auto to_lobe = [&](const glm::dvec3& w) {
    return glm::dvec3(glm::dot(t, w), glm::dot(b, w), glm::dot(n, w));
  };
  const auto to_mesh = [&](const glm::dvec3& w) { return w.x * t + w.y * b + w.z * n; };
  unsigned seed = 200;
  for (const double alpha : {0.01, 0.03, 0.1, 0.3, 0.6, 1.0}) {
    std::vector<ConeCase> cases = randomCones(glm::dvec2(alpha), half_rad, ++seed);
    const std::size_t n_padded = paddedCount(cases.size());
    std::vector<float> in(9 * n_padded), out(3 * n_padded);
    for (std::size_t i = 0; i < n_padded; ++i) {
      const ConeCase& c = cases[std::min(i, cases.size() - 1)];
      const glm::dvec3 vectors[] = {to_mesh(c.axis), to_mesh(c.view), n};
      for (std::size_t k = 0; k < 9; ++k)
        in[k * n_padded + i] = static_cast<float>(vectors[k / 3][static_cast<int>(k % 3)]);
    }
    Device& device = context.bench.device;
    Buffer output(device, out.size() * 4, BufferPurpose::kProbe, "mapped lobes under cones");
    const std::vector<ConeLight> light = {coneLight({0, 0, 1}, half_rad)};
    const std::vector<KernelArg> args = {probeData(context.bench, in),
                                         output,
                                         static_cast<std::uint32_t>(n_padded),
                                         probeData(context.bench, prepareLights(light)),
                                         static_cast<float>(alpha),
                                         0.0f};
    probeKernel(context.bench, "probes/probe_mapped_cone.cl", "probeMappedCone",
                fmt::format("-D WIDTH={} -D LIGHT_CONE=1 -D NORMAL_MAP=1 -D LOBES=1 -D DIFFUSE=1",
                            context.lanes))
        .launch(args, n_padded / static_cast<std::size_t>(context.lanes), kLocalSize);
    output.read(out.data(), out.size() * 4);
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const ConeCase c = {to_lobe(to_mesh(cases[i].axis)), to_lobe(to_mesh(cases[i].view))};
      const double want = reference::coneRadiance({c.axis, half_rad}, c.view, glm::dvec2(alpha),
                                                  glm::dvec3(1), kConeSamples)
                              .x;
      const double most = std::max(brightest(c, half_rad, glm::dvec2(alpha)), want);
      finding.add(std::abs(out[i] * power - want) / std::max(most, 1e-30));
    }
  }
  return finding;
}

// The half-vector cell, paraboloid-mapped, seen along the normal: the disc of half vectors over the
// share of a microdetail's lobe within it, in closed form.
Finding halfVectorCell(const CheckContext& context, double half_deg) {
  const double half_rad = half_deg * kDegree;
  Finding finding(half_deg <= 20 ? kConeProbability : kWideConeProbability);
  for (const double alpha : {0.01, 0.05, 0.2, 0.6}) {
    std::vector<ConeCase> cases = {{{0, 0, 1}, {0, 0, 1}}};
    const auto probed = probeCones(context, cases, materialOf({1, 1}, alpha), half_rad, false);
    const double slope = std::tan(half_rad / 2) / alpha, disc = std::tan(half_rad / 4);
    const double share = -std::expm1(-slope * slope);
    finding.add(std::abs(probed[0].cell_side / (std::sqrt(std::numbers::pi / share) * disc) - 1));
  }
  return finding;
}

Finding diffuse(const CheckContext& context, double half_deg) {
  Finding finding(kConeDiffuseTolerance / std::numbers::pi);
  std::vector<ConeCase> cases;
  for (const double elevation_deg : {90.0, 50.0, 10.0, 2.0, 0.5, 0.0, -0.5, -5.0, -40.0})
    cases.push_back({raised(elevation_deg * kDegree, 0.3), {0, 0, 1}});
  const double half_rad = half_deg * kDegree, power = 2 / (1 + std::cos(half_rad));
  const auto probed = probeCones(context, cases, materialOf({0.3, 0.3}, 0.2), half_rad, false);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double want = reference::coneDiffuse({cases[i].axis, half_rad}, kConeSamples);
    finding.add(std::abs(probed[i].cosine * power / std::numbers::pi - want));
  }
  return finding;
}

// The mean over many pixels of glints is the smooth lobe for lights of every size.
Finding glints(const CheckContext& context, double half_deg) {
  HandMadeFrame frame;
  frame.ray_origin = -raised(70 * kDegree, 0);
  frame.lights = {coneLight(raised(50 * kDegree, 160 * kDegree), half_deg * kDegree)};
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.05f, 0.05f}, 1e7f, 1);
  frame.pixels.resize(1 << 18);
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    HandMadePixel& pixel = frame.pixels[i];
    pixel.frame = flatFrame();
    const std::size_t column = i % 512, row = i / 512;
    pixel.footprint.u = fixedCoordinate(0.0123 * static_cast<double>(column));
    pixel.footprint.v = fixedCoordinate(0.0117 * static_cast<double>(row));
    pixel.footprint.duv_dx = {3e-3, 1e-3};
    pixel.footprint.duv_dy = {-1e-3, 4e-3};
  }
  KernelConfig config;
  config.width = context.lanes;
  config.light_cone = true;
  KernelConfig smooth_config = config;
  smooth_config.glint = smooth_config.size_variation = false;
  HandMadeFrame one = frame;
  one.pixels.resize(1);
  const double smooth = shadePixels(context.bench, one, smooth_config).radiance[0].x;
  Finding finding(kEnergyTolerance);
  for (const GlintMethod method :
       {GlintMethod::kZk16, GlintMethod::kExact, GlintMethod::kDistributed}) {
    config.method = method;
    double sum = 0;
    for (const glm::vec3& radiance : shadePixels(context.bench, frame, config).radiance)
      sum += radiance.x;
    finding.add(std::abs(sum / static_cast<double>(frame.pixels.size()) / smooth - 1));
  }
  return finding;
}

}  // namespace

std::vector<Check> coneChecks() {
  std::vector<Check> checks;
  const auto add = [&](const std::string& name, const char* measure, auto run, auto parameter) {
    checks.push_back({name, measure, [run, parameter](const CheckContext& context) {
                        return run(context, parameter);
                      }});
  };
  for (const double half_deg : {0.1, 0.5, 1.0, 5.0, 20.0, 45.0, 90.0}) {
    const std::string group = fmt::format("cone/{}deg_", half_deg);
    add(group + "lobe", "error over the brightest", lobe, ConeKind{half_deg, false});
    add(group + "groove", "error over the brightest", lobe, ConeKind{half_deg, true});
    add(group + "mapped", "error over the brightest", mapped, half_deg);
    add(group + "probability", "relative error", probability, ConeKind{half_deg, false});
    add(group + "groove_probability", "relative error", probability, ConeKind{half_deg, true});
    add(group + "half_vector_cell", "relative error of its side", halfVectorCell, half_deg);
    add(group + "diffuse", "absolute error", diffuse, half_deg);
    add(group + "glints", "mean over the smooth lobe - 1", glints, half_deg);
  }
  for (const double half_deg : {0.5, 3.0, 9.0, 20.0})
    add(fmt::format("cone/{}deg_silhouettes", half_deg), "error over the brightest", silhouettes,
        half_deg);
  for (const double half_deg : {5.0, 45.0})
    add(fmt::format("cone/{}deg_on_the_normal", half_deg), "error over the brightest", onTheNormal,
        half_deg);
  checks.push_back({"cone/narrow_probability", "relative error", narrowProbability});
  return checks;
}

}  // namespace glintmark
