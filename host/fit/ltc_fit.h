// Fits tables of linearly transformed cosines to microfacet BRDFs.
#pragma once
#include <functional>
#include <span>

#include "host/fit/ltc_lobe.h"
#include "host/parallel/ranks.h"

namespace glintmark {

struct LtcFitOptions {
  reference::Ndf ndf = reference::Ndf::kGgx;
  int size = LTC_SIZE_DEFAULT;
  int threads = 0;  // 0: all cores
  /// Called with the share done, in [0, 1], from one worker at a time; may be empty. Throwing from
  /// it ends the fit.
  std::function<void(double)> progress{};
  /// Rows of each pass are dealt out to these; each of them calls the fit, and gets the table.
  const Ranks* ranks = &aloneRanks();
};

/// The lobe that lies closest to the BRDF in the sense of ltcFitError: the better one of the minima
/// found from the first of `starts` (not empty), whose samples are used, and from the best of the
/// others. `symmetric` keeps the lobe round about the normal, for the view along it.
LtcLobe fitLtcLobe(reference::Ndf ndf, double alpha, double cos_theta,
                   std::span<const LtcLobe> starts, bool symmetric);

/// Roughness that column x of a table of `size` is fitted for: that of its node, except that column
/// 0, the limit of alpha -> 0, is measured at a very small one.
double ltcFitAlpha(int x, int size);

/// Fits a whole table. Bits do not depend on the number of threads and ranks. Throws Error for a
/// size outside LTC_SIZE_MIN to LTC_SIZE_MAX.
LtcTable fitLtcTable(const LtcFitOptions& options);

}  // namespace glintmark
