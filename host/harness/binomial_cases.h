// Trials and probabilities on both sides of every branch of the binomial sampler.
#pragma once
#include <random>
#include <vector>

#include "host/harness/kernel_bench.h"
#include "host/ocl/kernel_config.h"

namespace glintmark {

inline constexpr std::size_t kBinomialDraws = 1 << 16;

struct BinomialCase {
  double n, p;  // 0.3 trials are one with probability 0.3
};
std::vector<BinomialCase> binomialGrid();

/// Number of trials of one draw: a fraction is rounded up or down at random, as cells do.
float binomialTrials(const BinomialCase& c, std::mt19937& random);

/// kBinomialDraws draws of the kernels; `stratified`: their uniforms are evenly spaced.
std::vector<float> binomialDraws(KernelBench& bench, const BinomialCase& c, GlintMethod method,
                                 bool stratified, int lanes);

/// Distance between floats around x: counts beyond 2^24 are held to that.
double floatSpacing(double x);

}  // namespace glintmark
