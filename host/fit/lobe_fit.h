// Fits of lobes to simulated histograms. [PAT18] "Lobe Fitting"
#pragma once
#include <functional>
#include <vector>

#include "host/fit/lobe_model.h"
#include "host/simulate/simulation.h"

namespace glintmark {

/// A histogram of one order, coarser and folded about the plane of incidence: energy per solid
/// angle.
struct LobeData {
  static constexpr int kCosines = 16, kAzimuths = 16;  // azimuths over half a turn
  double alpha = 0, mu_in = 1;
  int order = 2;
  std::vector<double> energy;  // kCosines x kAzimuths
  double share = 0;            // over the hemisphere

  /// Directions of cell centres.
  static double cosine(int row) { return 1 - (row + 0.5) / kCosines; }
  static double azimuth(int column) { return (column + 0.5) * std::numbers::pi / kAzimuths; }
};
/// Takes one order of a simulation with azimuth 0; order 0: all orders together. `side`: 0 what
/// leaves above, 1 below, by the cosine from the normal down.
LobeData makeLobeData(const Simulation& simulation, int order, int side = 0);

/// Energy of the cell that holds a direction; azimuth [rad] over the whole turn.
double cellEnergy(const LobeData& data, double cosine, double azimuth);

/// The five parameters of [PAT18], "Customization".
struct FreeLobe {
  double scale = 0;          // [0, inf)
  double exponent = 1;       // eta of its roughness
  double flattening = 1;     // sigma_n
  double deviation_rad = 0;  // of the axis from the normal, towards the light's side negative
  double masking = 0;        // importance of the masking term, [0, 1]
  double error = 0;          // root mean square over the mean of the data

  /// The lobe's own roughness, in [0, 1]: eta = 2^(10 (1 - roughness)) - 1.
  double roughness() const { return 1 - std::log2(exponent + 1) / 10; }
};

/// Fits one lobe freely, by Ceres: all five parameters, or four and no masking. `deviation_rad`:
/// where the axis is looked for first; `exponent`, how narrow a lobe.
FreeLobe fitLobe(const LobeData& data, bool masking = true, double deviation_rad = 0,
                 double exponent = 1);
/// Its energy per solid angle.
double freeLobeEnergy(const FreeLobe& lobe, double alpha, double mu_in, double cosine,
                      double azimuth);

/// Fits the polynomials to all data of orders 2 and 3 at once, starting from [PAT18]'s, in the
/// sense of least squares over energy per solid angle. `masking`: one importance m of masking and
/// shadowing is fitted as well, else it is 0 as [PAT18] leaves it.
LobePolynomials fitPolynomials(const std::vector<LobeData>& data, bool masking = false);

/// Fits EON's roughness to data of all orders together at albedo 1, in the same sense.
EonRoughness fitEonRoughness(const std::vector<LobeData>& totals);
/// EON's energy per solid angle, light at azimuth 0.
double eonEnergy(double r, double mu_in, double cosine, double azimuth, double albedo = 1);

/// Fits the reciprocal model to single scattering (data of order 1) and to all orders together
/// (`totals`) at albedo 1, both relative to each simulation's mean.
ScatterFit fitScatter(const std::vector<LobeData>& data, const std::vector<LobeData>& totals);

/// Root mean square difference between a model of energy per solid angle (of cosine and azimuth)
/// and the data, over the mean of the data.
double lobeError(const LobeData& data,
                 const std::function<double(double cosine, double azimuth)>& model);

}  // namespace glintmark
