#include "host/mixture/half_mixtures.h"

#include <tbb/parallel_for.h>

#include <cmath>
#include <glm/gtc/packing.hpp>

namespace glintmark {

std::vector<std::uint16_t> packHalfMixtures(const NormalMixtures& mixtures) {
  const LargeArray<float4>& moments = mixtures.moments.texels;
  std::vector<std::uint16_t> halves(4 * moments.size());
  tbb::parallel_for(std::size_t{0}, moments.size(), [&](std::size_t i) {
    const NormalLobe lobe = lobeFromMoments(moments[i]);
    halves[4 * i] = glm::packHalf1x16(lobe.weight);
    halves[4 * i + 1] = glm::packHalf1x16(lobe.mean.x);
    halves[4 * i + 2] = glm::packHalf1x16(lobe.mean.y);
    halves[4 * i + 3] = glm::packHalf1x16(std::sqrt(lobe.variance));
  });
  return halves;
}

NormalLobe lobeFromHalves(const std::uint16_t* halves) {
  const float deviation = glm::unpackHalf1x16(halves[3]);
  return {glm::unpackHalf1x16(halves[0]),
          {glm::unpackHalf1x16(halves[1]), glm::unpackHalf1x16(halves[2])},
          deviation * deviation};
}

}  // namespace glintmark
