// What `fit lobes` shows of its fits: tables, coefficients, pictures of residuals.
#pragma once
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/fit/lobe_fit.h"
#include "host/fit/multiscatter_data.h"

namespace glintmark {

/// One order of one simulation with its free lobes.
struct FittedLobe {
  LobeData data;
  FreeLobe lobe;          // all five parameters
  double error_unmasked;  // of four, without masking
};

/// Everything that `fit lobes` fits, over roughness and incidence, both ascending.
struct LobeFits {
  std::vector<double> alphas, incidences_deg;
  std::vector<FittedLobe> lobes;  // alphas x incidences x orders from 1
  std::vector<LobeData> totals;   // alphas x incidences, all orders together
  MultiscatterData data;
  LobePolynomials masked;  // fitted with masking

  const FittedLobe& at(std::size_t alpha, std::size_t incidence, int order) const;
  int orders() const;
};

/// Parameters of every free lobe, comma separated.
std::string freeLobesCsv(const LobeFits& fits);
/// Means over incidences of one order: its share, and errors of free lobes and polynomials.
std::string lobeErrorTable(const LobeFits& fits, int order);
/// [PAT18]'s two sets of coefficients and ours.
std::string coefficientTable(const LobeFits& fits);
/// EON with its roughness equal to alpha, and fitted, over alpha.
std::string eonTable(const LobeFits& fits);
/// Mirrors: what simulated surfaces reflect by one bounce, and the kernels' lobe.
std::string mirrorTable(const LobeFits& fits);

/// Errors of order 2 over roughness and incidence as matrices, and sections of lobes in the plane
/// of incidence.
Image residualPicture(const LobeFits& fits);
/// Simulated lobes of order 2 at 60 degrees and the residuals by direction.
Image residualDiscs(const LobeFits& fits);

}  // namespace glintmark
