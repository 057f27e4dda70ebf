#include "host/mixture/normal_mixture.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"

namespace glintmark {

void checkMixtureOptions(const MixtureOptions& options) {
  const auto require = [](bool good, const char* sentence) {
    if (!good) throw Error(sentence);
  };
  if (options.lobes < 1 || options.lobes > kMaxLobes) {
    throw Error(
        fmt::format("a mixture cannot have {} lobes; it has 1 to {}", options.lobes, kMaxLobes));
  }
  require(options.passes >= 1, "a fit of mixtures needs at least 1 pass");
  require(options.sweeps >= 1, "a fit of mixtures needs at least 1 sweep");
  require(options.max_iterations >= 1, "a fit of mixtures needs at least 1 iteration");
  require(options.tolerance > 0, "the tolerance of a fit of mixtures must be above 0");
  require(options.prior_weight >= 0, "the prior weight of a fit of mixtures must be 0 or more");
  require(options.threads >= 0, "the number of threads must be 0 (all cores) or more");
}

float4 lobeMoments(const NormalLobe& lobe) {
  const float squares = 2 * lobe.variance + glm::dot(lobe.mean, lobe.mean);
  return {lobe.weight, lobe.weight * lobe.mean.x, lobe.weight * lobe.mean.y, lobe.weight * squares};
}

NormalLobe lobeFromMoments(const float4& moments) {
  if (!(moments.x > 0)) return {};
  const glm::vec2 mean(moments.y / moments.x, moments.z / moments.x);
  const float variance = 0.5f * (moments.w / moments.x - glm::dot(mean, mean));
  return {moments.x, mean, std::max(0.0f, variance)};
}

}  // namespace glintmark
