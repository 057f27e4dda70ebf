// Fits tables of linearly transformed cosines to anisotropic microfacet BRDFs.
#pragma once
#include <functional>

#include "host/fit/anisotropic_table.h"
#include "host/parallel/ranks.h"

namespace glintmark {

struct AnisotropicFitOptions {
  reference::Ndf ndf = reference::Ndf::kGgx;
  int threads = 0;  // 0: all cores
  /// Called with the share done, in [0, 1], from one worker at a time; may be empty. Throwing from
  /// it ends the fit.
  std::function<void(double)> progress{};
  /// Views of each pass are dealt out to these; each of them calls the fit, and gets the table.
  const Ranks* ranks = &aloneRanks();
};

/// Bits do not depend on the number of threads and ranks.
AnisotropicTable fitAnisotropicTable(const AnisotropicFitOptions& options);

}  // namespace glintmark
