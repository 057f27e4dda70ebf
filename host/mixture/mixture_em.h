// One EM step over many normals at once: the inner loop of the fit. [TAN05] Sect. 4.1
//
// Two ways to fill a vector: one texel per lane where texels have few normals, one normal per lane
// where they have many.
#pragma once
#include <cstddef>

#include "host/mixture/mixture_fit_types.h"
#include "host/mixture/normal_mixture.h"

namespace glintmark {

/// Texels that are fitted together, one per lane.
inline constexpr int kBlockTexels = 16;

/// A number per lobe and texel of a block.
using BlockValues = float[kMaxLobes][kBlockTexels];

/// The mixtures of a block's texels, their neighbours' sums, and what an E-step adds up.
struct alignas(64) MixtureBlock {
  BlockValues weight, mean_x, mean_y, variance;
  // Sums over the valid neighbours k of C a_k and C a_k mean_k.
  BlockValues prior_weight, prior_x, prior_y;
  // Sums over normals of responsibility r, r d, and r |d|^2, with d = normal - mean.
  BlockValues sum, sum_x, sum_y, sum_squares;
  float normals[kBlockTexels];         // total weight of a texel's normals, > 0
  float moved[kBlockTexels];           // largest change of a weight or mean in the last M-step
  float log_likelihood[kBlockTexels];  // sum over normals, where wanted
};

/// Normals of a block, one texel per lane: value j * kBlockTexels + lane.
struct BlockNormals {
  const float* x;
  const float* y;
  const float* weight;  // share of the normal under the texel, 0 for padding
  std::size_t count;    // normals per texel
};

/// E-step of every texel of the block: fills the sums and, if wanted, log_likelihood. A lobe of
/// weight 0 takes no part.
void expectBlock(MixtureBlock& block, int lobes, const BlockNormals& normals, bool likelihood);

/// A row of normals under one texel; `weight` and the arrays may be read kBlockTexels values beyond
/// `count`, where weight is 0.
struct NormalRow {
  const float* x;
  const float* y;
  const float* weight;
  std::size_t count;
  float row_weight;
};

/// E-step over rows of one texel's normals with the mixture in lane 0 of `block`. Adds to
/// totals[lobe] = (sum, sum_x, sum_y, sum_squares) and to totals[lobes][0] the log-likelihood.
void expectRows(const MixtureBlock& block, int lobes, const NormalRow* rows, std::size_t row_count,
                bool likelihood, double (*totals)[4]);

/// M-step of every texel of the block from its sums and priors; sets `moved`.
void maximizeBlock(MixtureBlock& block, int lobes);

}  // namespace glintmark
