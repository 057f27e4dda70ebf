#include "host/mixture/fournier_peaks.h"

#include <tbb/parallel_for.h>

#include "host/mixture/normal_mixture.h"

namespace glintmark {

MipTexels fournierPeaks(const NormalMap& map, int peaks, int threads,
                        const std::function<void(double)>& progress) {
  // A Phong peak cos^n is a Gaussian of variance 1 / n to first order, so that a mixture fitted to
  // each texel alone is a set of peaks.
  NormalMixtures mixtures = fitNormalMixtures(map,
                                              {.lobes = peaks,
                                               .surface = MixtureSurface::kInterpolated,
                                               .order = MixtureOrder::kIndependent,
                                               .threads = threads},
                                              progress);
  MipTexels texels = std::move(mixtures.moments);
  tbb::parallel_for(std::size_t{0}, texels.texels.size(), [&](std::size_t i) {
    const NormalLobe lobe = lobeFromMoments(texels.texels[i]);
    texels.texels[i] = {lobe.weight, lobe.mean.x, lobe.mean.y, lobe.variance};
  });
  return texels;
}

}  // namespace glintmark
