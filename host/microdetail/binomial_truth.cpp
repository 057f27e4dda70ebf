#include "host/microdetail/binomial_truth.h"

#include <fmt/format.h>

#include <cmath>
#include <random>

#include "host/core/error.h"

namespace glintmark {
namespace {

class Draws {
 public:
  Draws(double probability, CountLaw law, std::uint32_t seed)
      : probability_(probability), law_(law), random_(seed) {}

  // Of so many microdetails on average, how many reflect?
  std::int64_t reflecting(double details) {
    if (law_ == CountLaw::kPoisson)
      return details > 0 ? std::poisson_distribution<std::int64_t>(details * probability_)(random_)
                         : 0;
    const double whole = std::floor(details);
    const bool one_more = std::uniform_real_distribution<double>(0, 1)(random_) < details - whole;
    return of(static_cast<std::int64_t>(whole) + (one_more ? 1 : 0), probability_);
  }
  std::int64_t of(std::int64_t count, double share) {
    return std::binomial_distribution<std::int64_t>(count, share)(random_);
  }

 private:
  double probability_;
  CountLaw law_;
  std::mt19937_64 random_;
};

}  // namespace

BinomialFrames binomialFrames(std::size_t pixels, double details, double probability, double kept,
                              CountLaw law, std::uint32_t seed, double larger) {
  if (!(details > 0 && probability > 0 && probability <= 1))
    throw Error(
        fmt::format("{} microdetails of probability {} cannot be drawn; both must be above "
                    "0 and the second at most 1",
                    details, probability));
  if (!(kept >= 0 && kept <= 1))
    throw Error(fmt::format("a motion that keeps {} of a pixel is none from 0 to 1", kept));
  if (!(larger >= 1)) throw Error(fmt::format("a pixel made {} times as large is none", larger));
  Draws draws(probability, law, seed);
  const double expected = details * probability;
  BinomialFrames frames;
  std::vector<std::int64_t> all;
  for (std::size_t i = 0; i < pixels; ++i) {
    const std::int64_t k = draws.reflecting(details);
    all.push_back(k);
    const std::int64_t after = draws.of(k, kept) + draws.reflecting(details * (1 - kept));
    frames.still.push_back(static_cast<float>(static_cast<double>(k) / expected));
    frames.moved.push_back(static_cast<float>(static_cast<double>(after) / expected));
  }
  for (const std::int64_t k : all) {
    const std::int64_t more = draws.reflecting(details * (larger - 1));
    frames.zoomed.push_back(static_cast<float>(static_cast<double>(k + more) / expected / larger));
  }
  return frames;
}

}  // namespace glintmark
