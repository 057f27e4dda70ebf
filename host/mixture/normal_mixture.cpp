#include "host/mixture/normal_mixture.h"

#include <algorithm>

namespace glintmark {

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
