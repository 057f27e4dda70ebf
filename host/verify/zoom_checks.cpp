// Glints at every zoom: what one microdetail may add, and small changes that change few pixels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/harness/pixel_harness.h"
#include "host/harness/probes.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr double kDensity = 1e6;
constexpr double kMicro = 0.5;  // alpha_l / alpha_g: a light in the mirror direction reaches 1/4
constexpr double kReflecting = kMicro * kMicro;

// Square pixels at random places, `side` uv wide, seen and lit along the normal.
HandMadeFrame squarePixels(int count, double side, double places_uv) {
  HandMadeFrame frame;
  std::mt19937 random(21);
  const auto place = [&] {
    return fixedCoordinate(places_uv * (static_cast<double>(random()) * 0x1p-32 - 0.5));
  };
  frame.pixels.resize(static_cast<std::size_t>(count));
  for (HandMadePixel& pixel : frame.pixels) {
    pixel.footprint.u = place();
    pixel.footprint.v = place();
    pixel.footprint.duv_dx = {side, 0};
    pixel.footprint.duv_dy = {0, side};
    pixel.frame = flatFrame();
  }
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.3f * kMicro, 0.3f * kMicro}, kDensity);
  frame.lights = {coneLight({0, 0, 1})};
  return frame;
}

KernelConfig configOf(const CheckContext& context, GlintMethod method, bool glint = true) {
  KernelConfig config;
  config.width = context.lanes;
  config.method = method;
  config.glint = glint;
  return config;
}

// Radiance over the smooth lobe's.
std::vector<double> ratios(const CheckContext& context, GlintMethod method,
                           const HandMadeFrame& frame) {
  HandMadeFrame one = frame;
  one.pixels.resize(1);
  const double smooth =
      shadePixels(context.bench, one, configOf(context, method, false)).radiance[0].x;
  std::vector<double> result;
  for (const glm::vec3& radiance :
       shadePixels(context.bench, frame, configOf(context, method)).radiance)
    result.push_back(radiance.x / smooth);
  return result;
}

// From a million microdetails in a pixel to a million pixels in a microdetail.
Finding everyZoom(const CheckContext& context, GlintMethod method) {
  Finding finding(kEnergyTolerance);
  for (double per_pixel = 1e6; per_pixel > 0.9e-6; per_pixel *= 0.1) {
    const double side = std::sqrt(per_pixel / kDensity);
    const HandMadeFrame frame = squarePixels(1 << 18, side, std::max(2000 * side, 4.0));
    double sum = 0, brightest = 0;
    for (const double ratio : ratios(context, method, frame)) {
      sum += ratio;
      brightest = std::max(brightest, ratio);
    }
    finding.add(std::abs(sum / static_cast<double>(frame.pixels.size()) - 1));
    finding.require(brightest <= (1 + kShareTolerance) / kReflecting,
                    fmt::format("at {:.3g} microdetails a pixel, one is {:.4g} times the smooth "
                                "lobe",
                                per_pixel, brightest));
  }
  return finding;
}

// [ZK16] Sect. 3: where a microdetail is 32 pixels wide, neighbours see the same one.
Finding spanning(const CheckContext& context, GlintMethod method) {
  const double side = 1 / (32 * std::sqrt(kDensity));
  HandMadeFrame frame = squarePixels(1 << 14, side, 4);
  const std::vector<double> here = ratios(context, method, frame);
  for (HandMadePixel& pixel : frame.pixels) {
    pixel.footprint.u.fraction += static_cast<std::uint32_t>(side * 0x1p32);
  }
  const std::vector<double> beside = ratios(context, method, frame);
  double change = 0, contrast = 0;
  for (std::size_t i = 0; i < here.size(); ++i) {
    change += std::abs(here[i] - beside[i]);
    contrast += std::abs(here[i] - 1);
  }
  // An edge every 32 pixels, and tents twice as wide: at most 3 / 32 of the contrast.
  Finding finding(0.1);
  finding.add(change / contrast);
  finding.require(contrast > 0.3 * static_cast<double>(here.size()), "there is no contrast");
  return finding;
}

// Probabilities just below and above one where the sampler takes another way, for cells of exactly
// `trials` microdetails; all else stays.
struct Crossing {
  int trials;
  double probability;
};

Finding crossings(const CheckContext& context, GlintMethod method) {
  Finding finding(kCrossingShare);
  std::vector<Crossing> all = {{4, 0.5}, {64, 0.5}, {256, 0.5}};
  for (const double mean : {3.75, 5.0, 24.0, 32.0}) {
    for (const int trials : {256, 16384}) all.push_back({trials, mean / trials});
    all.push_back({256, 1 - mean / 256});
  }
  for (const Crossing& c : all) {
    // Pixels as large as a cell of the finer grid: its level is whole, and the coarser weighs 0.
    const double side = std::sqrt(c.trials / 0x1p20);
    HandMadeFrame frame = squarePixels(1 << 14, side, 2000 * side);
    frame.material.glints.density = 0x1p20f;
    const auto shares = [&](double probability) {
      const auto alpha_l = static_cast<float>(0.3 * std::sqrt(probability));
      frame.material.glints.alpha_l = {alpha_l, alpha_l};
      std::vector<double> result = ratios(context, method, frame);
      for (double& x : result) x *= probability;
      return result;
    };
    // Near 1 no finer step of a float's probability is.
    const double step = std::max(2e-6 * std::min(c.probability, 1 - c.probability),
                                 c.probability > 0.5 ? 1.5e-7 : 0.0);
    const std::vector<double> below = shares(c.probability - step),
                              above = shares(c.probability + step);
    double changed = 0;
    for (std::size_t i = 0; i < below.size(); ++i)
      changed += std::abs(below[i] - above[i]) > 0.02 / c.trials + 1e-5 * c.probability;
    finding.add(changed / static_cast<double>(below.size()));
  }
  return finding;
}

// k at a fixed seed while the probability or the number of trials rises.
Finding monotone(const CheckContext& context, GlintMethod method) {
  constexpr std::size_t kSeeds = 512, kSteps = 128;
  std::mt19937 random(22);
  std::vector<std::uint32_t> bits;
  std::vector<float> n, p;
  for (std::size_t seed = 0; seed < kSeeds; ++seed) {
    const auto drawn = static_cast<std::uint32_t>(random());
    const double fixed_n = std::floor(std::pow(10.0, seed % 8));
    const double fixed_p = std::pow(10.0, -static_cast<double>(seed % 6)) * 0.7;
    for (std::size_t step = 0; step < 2 * kSteps; ++step) {
      const double t = static_cast<double>(step % kSteps) / (kSteps - 1);
      const double odds = std::pow(10.0, -5 + 9 * t);  // p from 1e-5 to 1 - 1e-4
      bits.push_back(drawn);
      n.push_back(static_cast<float>(step < kSteps ? fixed_n : std::floor(std::pow(10.0, 6 * t))));
      p.push_back(static_cast<float>(step < kSteps ? odds / (1 + odds) : fixed_p));
    }
  }
  const auto k = probeBinomial(context.bench, bits, n, p, method, context.lanes);
  double falls = 0;
  for (std::size_t i = 1; i < k.size(); ++i) falls += i % kSteps != 0 && k[i] < k[i - 1];
  Finding finding(0);
  finding.add(falls);
  return finding;
}

}  // namespace

std::vector<Check> zoomChecks() {
  std::vector<Check> checks;
  for (const auto& [name, method] :
       {std::pair("zk16", GlintMethod::kZk16), std::pair("exact", GlintMethod::kExact),
        std::pair("distributed", GlintMethod::kDistributed)}) {
    const auto add = [&, name = name, method = method](
                         const std::string& property, const char* measure,
                         Finding (*run)(const CheckContext&, GlintMethod)) {
      checks.push_back(
          {fmt::format("zoom/{}_{}", name, property), measure,
           [run, method](const CheckContext& context) { return run(context, method); }});
    };
    add("energy", "mean over the smooth lobe - 1, at every zoom", everyZoom);
    add("spanning", "change to the next pixel, of the contrast", spanning);
    add("crossings", "share of pixels that a step of 4e-6 changes", crossings);
    add("monotone", "draws that fall while p or N rises", monotone);
  }
  return checks;
}

}  // namespace glintmark
