// How far filtered mixtures are from the normals they stand for.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "host/mixture/normal_mixture.h"

namespace glintmark {

/// A Gaussian lobe in double precision.
struct ReferenceLobe {
  double weight = 0;
  glm::dvec2 mean{0, 0};
  double variance = 0;  // per axis
};

/// Integral over the plane of the product of two mixtures, each widened by `variance` per axis.
double mixtureProduct(std::span<const ReferenceLobe> a, std::span<const ReferenceLobe> b,
                      double variance);

/// Squared L2 distance of two mixtures, both widened by `variance` > 0, over the squared norm of
/// `truth`: closed form. Widening stands for the roughness that shading adds.
double mixtureDistance(std::span<const ReferenceLobe> mixture, std::span<const ReferenceLobe> truth,
                       double variance);

struct InterpolationError {
  double fitted = 0;        // RMS relative distance at texel centres: what the fit itself loses
  double interpolated = 0;  // the same between texels, lobes mixed in closed form
};

/// Compares mixtures of `level` with the finest normals under them at `points` texel centres and
/// `points` corners between four texels, both drawn from `seed`; `deviation` per axis widens both
/// sides. Interpolation is bilinear in moments, [TAN05] Sect. 4.2; the truth pools the four texels'
/// normals with the same weights.
InterpolationError measureInterpolation(const NormalMap& map, const NormalMixtures& mixtures,
                                        int level, int points, double deviation,
                                        std::uint32_t seed);

/// What a filter halfway between two texels of `level` adds to the spread of the lobes because
/// lobes of one index differ: RMS over all pairs of side-by-side texels, within the map, of
/// sqrt(sum over lobes of a b / (a + b) |mean_a - mean_b|^2 / 2), in units of (nx, ny). 0 where
/// lobes of one index have one mean, and for a level of one texel.
double measureMisalignment(const NormalMixtures& mixtures, int level);

}  // namespace glintmark
