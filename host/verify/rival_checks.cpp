// Other authors' methods of glints: the mean each has, wrong where it is known to be wrong, and how
// it changes as the camera moves.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "host/harness/pixel_harness.h"
#include "host/harness/probes.h"
#include "host/harness/random_pixels.h"
#include "host/harness/tolerances.h"
#include "host/reference/rivals.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr double kRivalMicro = 0.1;                              // alpha_l / alpha_g
constexpr double kRivalProbability = kRivalMicro * kRivalMicro;  // along the normal

// Square pixels, `side` uv wide, at random places; seen and lit along the normal.
HandMadeFrame rivalFrame(int count, double side, double per_pixel, double moved_px = 0) {
  HandMadeFrame frame;
  std::mt19937 random(31);
  const auto place = [&] { return 64 * (static_cast<double>(random()) * 0x1p-32 - 0.5); };
  frame.pixels.resize(static_cast<std::size_t>(count));
  for (HandMadePixel& pixel : frame.pixels) {
    pixel.footprint.u = fixedCoordinate(place() + moved_px * side);
    pixel.footprint.v = fixedCoordinate(place());
    pixel.footprint.duv_dx = {side, 0};
    pixel.footprint.duv_dy = {0, side};
    pixel.frame = flatFrame();
  }
  const auto alpha_l = static_cast<float>(0.3 * kRivalMicro);
  frame.material = simpleMaterial({0.3f, 0.3f}, {alpha_l, alpha_l},
                                  static_cast<float>(per_pixel / (side * side)));
  frame.lights = {coneLight({0, 0, 1})};
  return frame;
}

// Radiance over the smooth lobe's.
std::vector<double> rivalRatios(const CheckContext& context, GlintMethod method,
                                const HandMadeFrame& frame, bool varies = false) {
  KernelConfig config;
  config.width = context.lanes;
  config.method = method;
  config.size_variation = varies;
  HandMadeFrame one = frame;
  one.pixels.resize(1);
  KernelConfig smooth = config;
  smooth.glint = false;
  const double lobe = shadePixels(context.bench, one, smooth).radiance[0].x;
  std::vector<double> result;
  for (const glm::vec3& radiance : shadePixels(context.bench, frame, config).radiance)
    result.push_back(radiance.x / lobe);
  return result;
}

double rivalMean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// What a gate and a Gaussian draw of n microdetails, on average, by a sum over the Gaussian.
double gatedMean(double n, bool as_published) {
  const double p = kRivalProbability, gate = -std::expm1(n * std::log1p(-p));
  const double mean = (n - 1) * p, sigma = std::sqrt(std::max(mean * (1 - p), 0.0));
  constexpr int kGaussianSteps = 4000;
  double sum = 0, weights = 0;
  for (int i = 0; i <= kGaussianSteps; ++i) {
    const double z = -6 + 12.0 * i / kGaussianSteps, weight = std::exp(-0.5 * z * z);
    const double x = mean + sigma * z;
    sum += weight * (as_published ? 1 + std::clamp(std::floor(x), 0.0, n)
                                  : std::clamp(1 + x, 1.0, std::max(n, 1.0)));
    weights += weight;
  }
  return (!as_published && n < 1 ? n * p : gate) * sum / weights;
}

// The gated Gaussian is no binomial: up to a quarter of the light too much where about one
// microdetail of a grid reflects. That is what is checked, to 1 %. Levels half-way between whole
// ones: half of the microdetails of either are drawn.
Finding gatedBias(const CheckContext& context, bool as_published) {
  Finding finding(kEnergyTolerance);
  const double side = std::exp2(-8.5) / 0.75;
  const auto method = as_published ? GlintMethod::kDeliotBelcour : GlintMethod::kDeliotCorrected;
  for (const double per_pixel : {10.0, 100.0, 1000.0, 1e5}) {
    const HandMadeFrame frame = rivalFrame(1 << 17, side, per_pixel);
    double predicted = 0;
    for (const int level : {-9, -8}) {
      const double n = per_pixel / (side * side) * std::exp2(2 * (level + (as_published ? 1 : 0)));
      predicted += gatedMean(0.5 * n, as_published) / (n * kRivalProbability);
    }
    finding.add(std::abs(rivalMean(rivalRatios(context, method, frame)) - predicted));
  }
  return finding;
}

// Spatial Gaussians are cut off at two cells, and nothing makes up for that.
Finding particleMean(const CheckContext& context) {
  Finding finding(kParticleLoss);
  for (const double per_pixel : {30.0, 300.0, 3000.0, 1e5})
    for (const double step : {1.0, 1.25, 1.6})
      finding.add(std::abs(rivalMean(rivalRatios(context, GlintMethod::kKemppinen,
                                                 rivalFrame(1 << 17, 1e-3 * step, per_pixel))) -
                           1));
  return finding;
}

// The authors' dictionary has a mean of its own, which is the surface's lobe roughly: along the
// normal, where turns change nothing, the square of all marginals' mean. Cells have a level from a
// normal distribution of deviation 2; those beyond the last have the lobe itself.
Finding dictionaryBias(const CheckContext& context) {
  Finding finding(kEnergyTolerance);
  const double side = std::exp2(-8.5);
  constexpr double kPeak = 0.0566 * 0.0566;  // of a microdetail in the dictionary
  for (const double per_pixel : {100.0, 1e4}) {
    const HandMadeFrame frame = rivalFrame(1 << 17, side, per_pixel);
    double predicted = 0;
    for (const double cell : {std::exp2(-9), std::exp2(-8)}) {
      const double count = per_pixel * std::pow(cell / side, 2) * kRivalProbability / kPeak;
      const double level = std::log2(count) / 2;
      const auto below = [&](double x) { return 0.5 * std::erfc((level - x) / std::sqrt(8.0)); };
      predicted += 0.5 * (1 - below(15.5));
      for (int l = 0; l < 16; ++l) {
        double mean = 0;
        for (std::uint32_t i = 0; i < 192; ++i)
          mean += reference::chermainMarginal(l, i, true, 0) / 192;
        const double share =
            (l == 15 ? below(15.5) : below(l + 0.5)) - (l == 0 ? 0 : below(l - 0.5));
        predicted += 0.5 * share * mean * mean * std::numbers::pi;
      }
    }
    finding.add(
        std::abs(rivalMean(rivalRatios(context, GlintMethod::kChermain, frame)) - predicted));
  }
  return finding;
}

// Even draws have the surface's lobe as their mean, at every slope.
Finding evenDictionary(const CheckContext& context) {
  Finding finding(kEnergyTolerance);
  for (const double per_pixel : {30.0, 1000.0, 1e5})
    for (const double slope : {0.0, 0.15, 0.4}) {
      HandMadeFrame frame = rivalFrame(1 << 17, 1.3e-3, per_pixel);
      frame.lights = {
          coneLight({std::sin(2 * std::atan(slope)), 0, std::cos(2 * std::atan(slope))})};
      finding.add(
          std::abs(rivalMean(rivalRatios(context, GlintMethod::kChermainCorrected, frame)) - 1));
    }
  return finding;
}

struct DrawMoments {
  double mean = 0, variance = 0;
  double all = 0;  // share of draws in which one of the two blended has all
};

// Of stratified draws by the published shader.
DrawMoments publishedMoments(const CheckContext& context, double n, double p) {
  constexpr std::size_t kDraws = 1 << 18;
  std::vector<float> u;
  for (std::size_t i = 0; i < kDraws; ++i)
    u.push_back(static_cast<float>((static_cast<double>(i) + 0.5) / kDraws));
  const std::vector<float> trials(kDraws, static_cast<float>(n)),
      odds(kDraws, static_cast<float>(p));
  DrawMoments m;
  double square = 0;
  for (const float k : probePublishedBinomial(context.bench, u, trials, odds, context.lanes)) {
    m.mean += k / double{kDraws};
    square += double{k} * k / kDraws;
    m.all += (k >= 0.05 * n + 20 ? 1.0 : 0.0) / kDraws;
  }
  m.variance = square - m.mean * m.mean;
  return m;
}

// Its Gaussian has the right mean and half of the variance: the inverse error function wants a root
// of 2.
Finding publishedVariance(const CheckContext& context) {
  Finding finding(kVarianceTolerance);
  for (const double p : {0.001, 0.05, 0.3}) {
    const double n = std::floor(200 / p);
    const DrawMoments m = publishedMoments(context, n, p);
    finding.add(std::abs(m.variance / (n * p * (1 - p)) - 0.5));
    finding.require(std::abs(m.mean / (n * p) - 1) < kEnergyTolerance, "the mean is off");
  }
  return finding;
}

// Sums of few microdetails are right on average, but for fireflies: where single precision lets
// the greater probability's sum pass first, all n reflect. Up to one draw in a thousand at
// p = 1e-4, and some in a hundred at 3e-6.
Finding publishedFireflies(const CheckContext& context) {
  Finding finding(kPublishedMean);
  for (const double mean : {0.2, 1.0, 4.0})
    finding.add(std::abs(publishedMoments(context, 100, mean / 100).mean / mean - 1));
  // How far single precision is off depends on the probability.
  const auto greatest = [&](double p) {
    double share = 0;
    for (int i = 0; i < 16; ++i)
      share = std::max(share, publishedMoments(context, std::floor(1 / p), p * (1 + 0.1 * i)).all);
    return share;
  };
  const double rare = greatest(1e-4), usual = greatest(3e-6);
  finding.require(rare > 0 && rare < 2e-3,
                  fmt::format("{:.2g} of the draws at 1e-4 are fireflies", rare));
  finding.require(usual > 0.005 && usual < 0.2,
                  fmt::format("{:.2g} of the draws at 3e-6 are fireflies", usual));
  return finding;
}

// The hash is the sine's last bits; and 3.14 leaves 157 rests of whole numbers, of which single
// precision makes some more.
Finding publishedHashes(const CheckContext& context) {
  std::vector<float> numbers;
  for (int n = 0; n < 1000000; ++n) numbers.push_back(static_cast<float>(n));
  std::vector<float> values = probeSineHash(context.bench, numbers, context.lanes);
  Finding finding(kSineHashShare);
  double others = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double off = std::abs(values[i] - reference::publishedHash(numbers[i]));
    others += std::min(off, 1 - off) > 1e-6;
  }
  finding.add(others / static_cast<double>(values.size()));
  std::ranges::sort(values);
  const auto last = std::unique(values.begin(), values.end());
  const auto distinct = static_cast<double>(last - values.begin());
  finding.require(distinct > 157 && distinct < 5000,
                  fmt::format("a million numbers have {} values", distinct));
  return finding;
}

// A hundredth of a pixel changes a hundredth of what a pixel does, or a few times that: nothing
// pops.
Finding rivalMotion(const CheckContext& context, GlintMethod method) {
  Finding finding(kRivalMotion);
  for (const double per_pixel : {100.0, 1e4}) {
    const std::vector<double> here =
        rivalRatios(context, method, rivalFrame(1 << 14, 1.3e-3, per_pixel));
    const std::vector<double> moved =
        rivalRatios(context, method, rivalFrame(1 << 14, 1.3e-3, per_pixel, 0.01));
    double change = 0, contrast = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      change += std::abs(here[i] - moved[i]);
      contrast += std::abs(here[i] - 1);
    }
    finding.add(change / contrast);
    finding.require(change > 0, "nothing moves");
  }
  return finding;
}

}  // namespace

std::vector<Check> rivalChecks() {
  std::vector<Check> checks = {
      {"rival/deliot_belcour_bias", "mean off what its gates and Gaussians have",
       [](const CheckContext& context) { return gatedBias(context, true); }},
      {"rival/deliot_corrected_bias", "mean off what its gates and Gaussians have",
       [](const CheckContext& context) { return gatedBias(context, false); }},
      {"rival/kemppinen_mean", "mean over the smooth lobe - 1", particleMean},
      {"rival/chermain_bias", "mean off what its dictionary has", dictionaryBias},
      {"rival/chermain_corrected_mean", "mean over the smooth lobe - 1", evenDictionary},
      {"rival/published_zk16_fireflies", "mean of few reflecting ones, - 1", publishedFireflies},
      {"rival/published_zk16_variance", "variance over the binomial's, less a half",
       publishedVariance},
      {"rival/published_zk16_hash", "share of numbers with other hashes", publishedHashes}};
  for (const auto& [name, method] :
       {std::pair("deliot_belcour", GlintMethod::kDeliotBelcour),
        std::pair("deliot_corrected", GlintMethod::kDeliotCorrected),
        std::pair("kemppinen", GlintMethod::kKemppinen),
        std::pair("chermain", GlintMethod::kChermain),
        std::pair("chermain_corrected", GlintMethod::kChermainCorrected),
        std::pair("published_zk16", GlintMethod::kPublishedZk16)})
    checks.push_back(
        {fmt::format("rival/{}_motion", name), "change per hundredth of a pixel, per contrast",
         [method = method](const CheckContext& context) { return rivalMotion(context, method); }});
  return checks;
}

}  // namespace glintmark
