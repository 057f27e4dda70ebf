#include "host/microdetail/detail_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/core/error.h"
#include "host/microdetail/microdetail_types.h"

namespace glintmark {
namespace {

constexpr double kLeastMean = 24;
constexpr std::uint32_t kAll = 0xFFFFFFFFu;
constexpr double kLeastFactor = 1.0 / 32;
constexpr std::size_t kSizes = 1024;

// P(count <= k) for k from 0 on, up to where nothing is left.
std::vector<double> distribution(double mean, CountLaw law) {
  std::vector<double> cdf;
  double sum = 0;
  for (int k = 0; sum < 1 - 1e-12 && k < 1000; ++k) {
    if (law == CountLaw::kPoisson)
      sum += std::exp(k * std::log(mean) - mean - std::lgamma(k + 1.0));
    else
      sum += std::max(0.0, 1 - std::abs(k - mean));
    cdf.push_back(sum);
  }
  return cdf;
}

}  // namespace

DetailCounts detailCounts(double density, CountLaw law) {
  if (!(density >= 1e-16 && density <= 1e19))
    throw Error(
        fmt::format("a density of {} microdetails per uv area is not from 1e-16 to 1e19", density));
  DetailCounts made;
  made.cell_level = static_cast<int>(std::ceil(0.5 * std::log2(kLeastMean / density)));
  const double mean = density * std::exp2(2.0 * made.cell_level);
  std::vector<std::uint32_t> thresholds;
  for (const double probability : distribution(mean, law))
    thresholds.push_back(static_cast<std::uint32_t>(std::min(probability * 0x1p32, 0x1p32 - 1)));
  thresholds.back() = kAll;
  for (std::uint32_t byte = 0; byte < MD_GUIDE; ++byte) {
    const auto first = std::ranges::lower_bound(thresholds, byte << 24);
    made.table.push_back(static_cast<std::uint32_t>(first - thresholds.begin()));
  }
  made.table.insert(made.table.end(), thresholds.begin(), thresholds.end());
  return made;
}

DetailSizes detailSizes(double variation) {
  if (!(variation > 0)) return {1, {1}};
  // Mass m f(m) and size 1 / m over a fine grid of the normal distribution, smallest sizes first.
  constexpr int kSteps = 1 << 17;
  constexpr double kReach = 7;  // sigmas
  std::vector<std::pair<double, double>> parts;
  double mass = 0, number = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double g = kReach * (2 * (i + 0.5) / kSteps - 1);
    const double density = std::exp(-0.5 * g * g);
    const double factor = std::max(std::abs(1 + variation * g), kLeastFactor);
    parts.emplace_back(1 / factor, density * factor);
    mass += density;
    number += density * factor;
  }
  std::ranges::sort(parts);
  DetailSizes made;
  made.number_factor = number / mass;
  // Equal shares of the number, each of its mean size.
  std::vector<double> sums(kSizes, 0.0), shares(kSizes, 0.0);
  double before = 0;
  for (const auto& [size, share] : parts) {
    const double middle = (before + 0.5 * share) / number;
    const auto at =
        std::min(static_cast<std::size_t>(middle * static_cast<double>(kSizes)), kSizes - 1);
    sums[at] += share * size;
    shares[at] += share;
    before += share;
  }
  // Shares are equal up to a step of the grid; the mean is made exact.
  double mean = 0;
  for (std::size_t i = 0; i < kSizes; ++i) mean += sums[i] / shares[i] / kSizes;
  for (std::size_t i = 0; i < kSizes; ++i)
    made.sizes.push_back(static_cast<float>(sums[i] / shares[i] / (mean * made.number_factor)));
  return made;
}

}  // namespace glintmark
