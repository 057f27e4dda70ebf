// Single functions of the kernels over arrays, on the device.
#pragma once
#include <cstdint>
#include <vector>

#include "host/core/shared_types.h"
#include "host/harness/kernel_bench.h"
#include "host/ocl/kernel_config.h"
#include "host/reference/footprint.h"

namespace glintmark {

/// As numbered in probe_glint.cl.
enum class MathFunction : std::int32_t {
  kExp2,
  kLog2,
  kReciprocal,
  kRsqrt,
  kNormalUpperQuantile,
  kRoot,
  kExpComplement
};

/// y = function(x) by the kernels of `width` lanes.
std::vector<float> probeMath(KernelBench& bench, MathFunction function, const std::vector<float>& x,
                             int width);

struct HashProbe {
  std::vector<std::uint32_t> coherent_u, cell_seed, pair_seed;
};
/// Coherent index of cell_u, seed of (cell_u, cell_v), and of that with half-vector cell (ju, jv).
HashProbe probeHash(KernelBench& bench, const std::vector<std::int32_t>& cell_u,
                    const std::vector<std::int32_t>& cell_v, const std::vector<std::int32_t>& ju,
                    const std::vector<std::int32_t>& jv, int width);

struct RandomProbe {
  std::vector<float> uniform, gauss;
};
/// U(bits) and the byte Gaussian of bits.
RandomProbe probeRandom(KernelBench& bench, const std::vector<std::uint32_t>& bits, int width);

struct FootprintProbe {
  std::vector<float> fine_level, coarse_weight, extent_u, extent_v;
};
/// Which grids a footprint meets, and its box [uv] after stretching; K_a and the material's
/// compression and finest level as given.
FootprintProbe probeFootprints(KernelBench& bench,
                               const std::vector<reference::PixelFootprint>& footprints,
                               const GlintMaterial& glints, GlintMethod method, int ka, int width);

/// Number of successes among n trials of probability p, where P(more) is the uniform number of the
/// random bits.
std::vector<float> probeBinomial(KernelBench& bench, const std::vector<std::uint32_t>& bits,
                                 const std::vector<float>& n, const std::vector<float>& p,
                                 GlintMethod method, int width);

/// The published shader's hash of numbers, and its binomial draws; u: uniform numbers.
std::vector<float> probeSineHash(KernelBench& bench, const std::vector<float>& n, int width);
std::vector<float> probePublishedBinomial(KernelBench& bench, const std::vector<float>& u,
                                          const std::vector<float>& n, const std::vector<float>& p,
                                          int width);

}  // namespace glintmark
