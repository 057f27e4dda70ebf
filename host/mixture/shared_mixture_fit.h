// The fit of mixtures by several ranks.
#pragma once
#include <functional>

#include "host/mixture/normal_mixture.h"
#include "host/parallel/ranks.h"

namespace glintmark {

/// Of all `ranks`: what fitNormalMixtures() fits, to the bit, at each of them. Blocks of texels,
/// and at coarse levels the normals below a texel, are dealt out; after every batch of texels all
/// have all of them. What takes less than telling takes is fitted by every one of them.
NormalMixtures fitMixturesShared(const Ranks& ranks, const NormalMap& map,
                                 const MixtureOptions& options,
                                 const std::function<void(double)>& progress = {});

}  // namespace glintmark
