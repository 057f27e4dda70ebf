// Geometric antialiasing: whole pixels of curved meshes against the widened lobe in double
// precision, against sums over their footprints, and at the limits of steps.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "host/core/angles.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/reference/beckmann.h"
#include "host/reference/curved_lobe.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

using reference::CurvatureFilter;

struct CurvedKind {
  GeometricAa switch_value;
  CurvatureFilter filter;
  bool ggx = false;
};

constexpr CurvedKind kBySlopes = {GeometricAa::kKaplanyan2016, CurvatureFilter::kSlopes};
constexpr CurvedKind kByNormals = {GeometricAa::kTokuyoshi2019, CurvatureFilter::kNormals};
constexpr CurvedKind kByProjected = {GeometricAa::kProjected2021, CurvatureFilter::kProjected};
constexpr CurvedKind kByProjectedGgx = {GeometricAa::kProjected2021, CurvatureFilter::kProjected,
                                        true};

constexpr CurvedKind kByFootprint = {GeometricAa::kFootprint, CurvatureFilter::kFootprint};
constexpr CurvedKind kByFootprintGgx = {GeometricAa::kFootprint, CurvatureFilter::kFootprint, true};

KernelConfig curvedConfig(const CheckContext& context, CurvedKind kind) {
  KernelConfig config;
  config.width = context.lanes;
  config.glint = config.size_variation = false;
  config.ggx = kind.ggx;
  config.geometric_aa = kind.switch_value;
  return config;
}

HandMadeFrame curvedFrame(const float2& alpha, int count, unsigned seed) {
  HandMadeFrame frame;
  frame.material = simpleMaterial(alpha, {0.01f, 0.01f}, 1);
  setRandomRays(frame);
  frame.pixels = randomPixels(count, {}, seed);
  return frame;
}

// What the kernel sees: planes and rays are floats.
reference::CurvedPixel curvedPixel(const HandMadeFrame& frame, const HandMadePixel& pixel) {
  const auto seen = [](const glm::dvec3& v) { return glm::dvec3(glm::vec3(v)); };
  reference::CurvedPixel curved;
  curved.frame = unpackFrame(pixel.frame);
  curved.normal_dx = seen(pixel.normal_dx);
  curved.normal_dy = seen(pixel.normal_dy);
  curved.ray_dx = seen(frame.ray_dx);
  curved.ray_dy = seen(frame.ray_dy);
  curved.ray = seen(frame.ray_origin) + curved.ray_dx * static_cast<double>(pixel.x) +
               curved.ray_dy * static_cast<double>(pixel.y);
  return curved;
}

// Normals that turn by 10^-4 to 2 radians per pixel, and by nothing in every eighth pixel.
Finding againstReference(const CheckContext& context, CurvedKind kind) {
  Finding finding(1);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> sign(-1, 1), decades(-4, 0.3);
  unsigned seed = 0;
  for (const float2 alpha : {float2{0.03f, 0.03f}, {0.1f, 0.1f}, {0.5f, 0.15f}, {1, 1}})
    for (const double elevation_deg : {80.0, 40.0, 10.0}) {
      HandMadeFrame frame = curvedFrame(alpha, 256, ++seed);
      const double e = elevation_deg * kDegree, azimuth = 1.3 * seed;
      frame.lights = {coneLight(
          {std::cos(e) * std::cos(azimuth), std::cos(e) * std::sin(azimuth), std::sin(e)})};
      for (std::size_t i = 0; i < frame.pixels.size(); ++i)
        for (glm::dvec3* step : {&frame.pixels[i].normal_dx, &frame.pixels[i].normal_dy})
          *step = (i % 8 == 0 ? 0 : std::pow(10, decades(random))) *
                  glm::dvec3(sign(random), sign(random), sign(random));
      const ShadedPixels shaded = shadePixels(context.bench, frame, curvedConfig(context, kind));
      const float4& axis = frame.lights[0].direction;
      const glm::dvec3 light = glm::normalize(glm::dvec3(axis.x, axis.y, axis.z));
      for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
        const reference::CurvedPixel pixel = curvedPixel(frame, frame.pixels[i]);
        const glm::dvec3 n = pixel.frame.normal;
        if (-glm::dot(glm::normalize(pixel.ray), n) < 0.05) continue;
        const double want =
            reference::curvedLobe(pixel, light, glm::dvec2(alpha.x, alpha.y), kind.filter,
                                  kind.ggx ? reference::Ndf::kGgx : reference::Ndf::kBeckmann);
        finding.add(std::abs(shaded.radiance[i].x - want) / (kMaskingTolerance * want + 2e-5));
      }
    }
  return finding;
}

// Steps up to a roughness: the mean over the slopes that a pixel's box has, summed one by one, over
// the brightest of that footprint.
Finding overFootprints(const CheckContext& context, CurvedKind kind) {
  constexpr int kSide = 24;
  Finding finding(kind.ggx ? kFootprintGgx : kFootprintMean);
  const reference::Ndf ndf = kind.ggx ? reference::Ndf::kGgx : reference::Ndf::kBeckmann;
  std::mt19937 random(9);
  std::uniform_real_distribution<double> sign(-1, 1), unit(0, 1);
  for (const float2 alpha : {float2{0.03f, 0.03f}, {0.2f, 0.08f}}) {
    const glm::dvec2 a(alpha.x, alpha.y);
    HandMadeFrame frame = curvedFrame(alpha, 192, 5);
    frame.ray_dx = frame.ray_dy = glm::dvec3(0);
    const glm::dvec3 view = -glm::normalize(frame.ray_origin);
    frame.lights = {coneLight(glm::dvec3(0.3, 0.2, 1))};
    const float4& axis = frame.lights[0].direction;
    const glm::dvec3 light = glm::normalize(glm::dvec3(axis.x, axis.y, axis.z));
    for (HandMadePixel& pixel : frame.pixels) {
      const glm::dvec2 off = 1.5 * a * glm::dvec2(sign(random), sign(random));
      pixel.frame = packFrame(glm::normalize(light + view) + glm::dvec3(off, 0), {1, 0, 0}, false);
      for (glm::dvec3* step : {&pixel.normal_dx, &pixel.normal_dy})
        *step = unit(random) * glm::dvec3(a.x * sign(random), a.y * sign(random), 0);
    }
    const ShadedPixels shaded = shadePixels(context.bench, frame, curvedConfig(context, kind));
    for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
      const reference::CurvedPixel pixel = curvedPixel(frame, frame.pixels[i]);
      const auto local = [&](const glm::dvec3& w) {
        return glm::dvec3(glm::dot(pixel.frame.tangent, w), glm::dot(pixel.frame.bitangent, w),
                          glm::dot(pixel.frame.normal, w));
      };
      const glm::dvec3 in = local(light), out = local(view), m = glm::normalize(in + out);
      const auto [right, down] = reference::projectedSteps(pixel, light);
      const auto density = [&](const glm::dvec2& slope) {
        return reference::parallelogramDensity(slope, right, down, a, ndf, kSide);
      };
      // G / (4 o.n) and the Jacobian; lobes of these roughnesses mask nothing at these views.
      const double factor = 1 / (4 * out.z * std::pow(m.z, 4));
      finding.add(std::abs(shaded.radiance[i].x - density(glm::dvec2(m) / m.z) * factor) /
                  (density(glm::dvec2(0)) * factor));
    }
  }
  return finding;
}

// A highlight that a row of pixels of a sphere is too coarse for: the mean over all pixels is that
// of the lobe, whatever width it is given.
Finding energy(const CheckContext& context, CurvedKind kind) {
  constexpr double kTurn = 0.12;  // radians per pixel
  constexpr int kSide = 11, kFine = 12;
  constexpr double kAlpha = 0.06;
  Finding finding(kCurvedEnergy);
  for (const double view_deg : {0.0, 45.0}) {
    const glm::dvec3 view(std::sin(view_deg * kDegree), 0, std::cos(view_deg * kDegree));
    const glm::dvec3 light(-view.x, view.y, view.z);
    HandMadeFrame frame =
        curvedFrame({static_cast<float>(kAlpha), static_cast<float>(kAlpha)}, kSide * kSide, 1);
    frame.ray_origin = -view;
    frame.ray_dx = frame.ray_dy = glm::dvec3(0);
    frame.lights = {coneLight(light)};
    double fine = 0;
    const auto normalAt = [](double x, double y) {
      return glm::normalize(glm::dvec3(kTurn * (x - 0.3), kTurn * (y + 0.2), 1));
    };
    for (int j = 0; j < kSide; ++j)
      for (int i = 0; i < kSide; ++i) {
        const double x = i - kSide / 2, y = j - kSide / 2;
        HandMadePixel& pixel = frame.pixels[static_cast<std::size_t>(j * kSide + i)];
        pixel.frame = packFrame(normalAt(x, y), {1, 0, 0}, false);
        pixel.normal_dx = (normalAt(x + 1e-4, y) - normalAt(x - 1e-4, y)) / 2e-4;
        pixel.normal_dy = (normalAt(x, y + 1e-4) - normalAt(x, y - 1e-4)) / 2e-4;
        for (int k = 0; k < kFine * kFine; ++k) {
          const ShadingFrame f = unpackFrame(packFrame(
              normalAt(x + (k % kFine + 0.5) / kFine - 0.5, y + (k / kFine + 0.5) / kFine - 0.5),
              {1, 0, 0}, false));
          const auto local = [&](const glm::dvec3& w) {
            return glm::dvec3(glm::dot(f.tangent, w), glm::dot(f.bitangent, w),
                              glm::dot(f.normal, w));
          };
          fine += reference::brdfTimesCosine(local(light), local(view), glm::dvec2(kAlpha),
                                             glm::dvec3(1))
                      .x /
                  (kFine * kFine);
        }
      }
    double coarse = 0;
    for (const glm::vec3& radiance :
         shadePixels(context.bench, frame, curvedConfig(context, kind)).radiance)
      coarse += radiance.x;
    finding.add(std::abs(coarse / fine - 1));
  }
  return finding;
}

// Steps from nothing to the largest floats: radiance is finite and not negative.
Finding hardSteps(const CheckContext& context, CurvedKind kind) {
  Finding finding(0);
  const double most = std::numeric_limits<float>::max();
  for (const float alpha : {1e-3f, 0.1f, 1.0f}) {
    HandMadeFrame frame = curvedFrame({alpha, alpha}, 192, 3);
    frame.lights = {coneLight({0.2, 0.1, 1}), coneLight({1, 0, 0.001}), coneLight({0.3, 0, -1})};
    std::size_t i = 0;
    for (HandMadePixel& pixel : frame.pixels) {
      const double sizes[] = {0, 1e-38, 1e-12, 1, 1e4, 1e20, most};
      pixel.normal_dx = sizes[i % 7] * glm::dvec3(1, i % 2 == 0 ? -1.0 : 0.0, 0);
      pixel.normal_dy = sizes[i / 7 % 7] * glm::dvec3(0, 1, i % 3 == 0 ? 1.0 : 0.0);
      ++i;
    }
    for (const glm::vec3& radiance :
         shadePixels(context.bench, frame, curvedConfig(context, kind)).radiance)
      finding.add(std::isfinite(radiance.x) && radiance.x >= 0 ? 0 : 1);
  }
  return finding;
}

}  // namespace

std::vector<Check> curvatureChecks() {
  std::vector<Check> checks;
  const auto add = [&](const char* name, const char* measure, auto check, CurvedKind kind) {
    checks.push_back(
        {name, measure, [=](const CheckContext& context) { return check(context, kind); }});
  };
  const char* in_bounds = "error in units of its bound";
  add("curvature/kaplanyan2016", in_bounds, againstReference, kBySlopes);
  add("curvature/tokuyoshi2019", in_bounds, againstReference, kByNormals);
  add("curvature/projected2021", in_bounds, againstReference, kByProjected);
  add("curvature/projected2021_ggx", in_bounds, againstReference, kByProjectedGgx);
  add("curvature/footprint", in_bounds, againstReference, kByFootprint);
  const char* over = "of the brightest of a footprint";
  add("curvature/footprint_box", over, overFootprints, kByFootprint);
  add("curvature/footprint_box_ggx", over, overFootprints, kByFootprintGgx);
  const char* of_mean = "of a coarse highlight's mean";
  add("curvature/energy_kaplanyan2016", of_mean, energy, kBySlopes);
  add("curvature/energy_tokuyoshi2019", of_mean, energy, kByNormals);
  add("curvature/energy_projected2021", of_mean, energy, kByProjected);
  add("curvature/energy_footprint", of_mean, energy, kByFootprint);
  const char* bad = "pixels that are not sane";
  add("curvature/hard_kaplanyan2016", bad, hardSteps, kBySlopes);
  add("curvature/hard_tokuyoshi2019", bad, hardSteps, kByNormals);
  add("curvature/hard_projected2021", bad, hardSteps, kByProjected);
  add("curvature/hard_footprint", bad, hardSteps, kByFootprint);
  return checks;
}

}  // namespace glintmark
