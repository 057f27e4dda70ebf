// Derives the constants of kernels/area/meso_table.h and says how good they are.
#pragma once
#include <array>
#include <functional>
#include <vector>

#include "host/parallel/ranks.h"

namespace glintmark {

/// Constants of method `exact`, in the order of kernels/area/meso_table.h.
struct MesoConstants {
  std::array<double, 9> inverse{};  // INVERSE_0 to INVERSE_8
  std::array<double, 4> join{};     // JOIN_A to JOIN_D
};

/// Those of kernels/area/meso_table.h.
MesoConstants shippedMesoConstants();

/// alpha_me of a mean length, clamped to [0, 1]; any length, also beyond 1.
double mesoAlpha(const MesoConstants& constants, double length);

/// Overall roughness of alpha_mi and alpha_me, each in [0, 1]; in [0, 1].
double overallAlpha(const MesoConstants& constants, double alpha_mi, double alpha_me);

/// What overallAlpha approximates: the closest scaled cosine to the convolution of lobes i / count
/// and j / count, i and j from 1 to count, clamped to 1.
struct MesoGrid {
  int count = 0;
  std::vector<double> alpha;  // count x count

  double at(int i, int j) const { return alpha[static_cast<std::size_t>(i - 1) * count + j - 1]; }
};

/// Convolves numerically; parallel, and rows are dealt out to `ranks`, each of which calls it.
/// Throws Error for a count outside 1 to 33.
MesoGrid computeMesoGrid(int count, const Ranks& ranks = aloneRanks());

/// Fits the constants: Chebyshev interpolation of the inverse, least squares over `grid`.
MesoConstants fitMeso(const MesoGrid& grid);

/// Errors of an approximation over the grid, as [TAO21] Sect. 3.5 states that of Eq. 7.
struct MesoErrors {
  double sum_of_squares = 0, max = 0;
};
MesoErrors mesoErrors(const MesoGrid& grid,
                      const std::function<double(double alpha_mi, double alpha_me)>& overall);

/// Largest relative error of mesoAlpha for roughness from 0.001 to 1.
double mesoInverseError(const MesoConstants& constants);

}  // namespace glintmark
