// Clustered start of a fit. [TAN05] Sect. 4.1
#pragma once
#include <span>
#include <vector>

#include "host/mixture/normal_mixture.h"

namespace glintmark {

struct WeightedNormal {
  glm::vec2 xy{0, 0};
  float weight = 1;
};

/// `lobes` clusters of `normals` (not empty) by k-means from well-spread centres, as lobes with
/// their weights, means and variances. Deterministic. Fewer distinct normals than lobes leave some
/// with weight 0 at another's place.
std::vector<NormalLobe> clusterNormals(std::span<const WeightedNormal> normals, int lobes);

}  // namespace glintmark
