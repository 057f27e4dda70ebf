// What simulations and fits leave for the kernels: data/multiscatter.json.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/fit/lobe_model.h"

namespace glintmark {

/// Energy that a rough mirror (Fresnel term 1) reflects by one bounce, simulated.
struct MirrorAlbedo {
  std::vector<double> alphas, mus;  // ascending; mu: cosine of incidence
  std::vector<double> energy;       // alphas x mus

  /// Bilinear; alpha and mu are clamped to the table.
  double at(double alpha, double mu) const;
};

struct MultiscatterData {
  LobePolynomials refit;
  MirrorAlbedo mirror;
  std::string source;  // how the figures were made, one sentence
};

std::string toJson(const MultiscatterData& data);
/// Throws Error naming the file: not JSON, keys missing, wrong sizes, values out of range.
MultiscatterData readMultiscatterData(const std::filesystem::path& path);
/// The project's, read once.
const MultiscatterData& multiscatterData();

}  // namespace glintmark
