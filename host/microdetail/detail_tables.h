// How many microdetails there are and how large: the tables that place_details.cl draws from.
#pragma once
#include <cstdint>
#include <vector>

namespace glintmark {

/// How many microdetails a reference cell holds.
enum class CountLaw {
  /// Places are independent of each other and of any grid: counts of any part of the texture are
  /// Poisson, and cells of any size give the same surface. Of n microdetails, each reflecting with
  /// probability p, the number that reflect varies by (mean n) p: 1 / (1 - p) times the binomial's.
  kPoisson,
  /// The mean, rounded up or down by chance: where a pixel is large against a cell it holds the
  /// same
  /// number as its neighbour, and what reflects is binomial.
  kFixed,
};

/// Reference cells of one level and the distribution of their counts.
struct DetailCounts {
  int cell_level = 0;                // cells are 2^cell_level wide [uv]
  std::vector<std::uint32_t> table;  // layout in kernels/microdetail/microdetail.h
};

/// For `density` microdetails per unit uv area: cells of 24 to 96 on average. Throws Error for a
/// density that is not from 1e-16 to 1e19, for which there is no level.
DetailCounts detailCounts(double density, CountLaw law);

/// Sizes of microdetails under a variation v of [ZK16] Sect. 4.3: the density where one lies is m
/// times the mean, m = max(|1 + v g|, 1/32) with g normal, and the microdetail 1 / m in size. So
/// there are E[m] times as many, of m's density weighted by m.
struct DetailSizes {
  double number_factor = 1;  // E[m]
  std::vector<float> sizes;  // equally likely, their mean 1 / number_factor
};
DetailSizes detailSizes(double variation);

}  // namespace glintmark
