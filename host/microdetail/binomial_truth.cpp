#include "host/microdetail/binomial_truth.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "host/core/error.h"

namespace glintmark {

std::vector<float> binomialRatios(std::size_t pixels, double details, double probability,
                                  CountLaw law, std::uint32_t seed) {
  if (!(details > 0 && probability > 0 && probability <= 1))
    throw Error(
        fmt::format("{} microdetails of probability {} cannot be drawn; both must be above "
                    "0 and the second at most 1",
                    details, probability));
  std::mt19937_64 random(seed);
  std::poisson_distribution<std::int64_t> poisson(details * probability);
  std::uniform_real_distribution<double> chance(0, 1);
  const double whole = std::floor(details);
  std::vector<float> ratios;
  for (std::size_t i = 0; i < pixels; ++i) {
    std::int64_t k = 0;
    if (law == CountLaw::kPoisson) {
      k = poisson(random);
    } else {
      const auto n = static_cast<std::int64_t>(whole) + (chance(random) < details - whole ? 1 : 0);
      k = std::binomial_distribution<std::int64_t>(n, probability)(random);
    }
    ratios.push_back(static_cast<float>(static_cast<double>(k) / (details * probability)));
  }
  return ratios;
}

}  // namespace glintmark
