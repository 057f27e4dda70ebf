// What simulations and fits leave for the kernels: data/multiscatter.json.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "host/fit/lobe_model.h"

namespace glintmark {

/// Energy that a rough mirror (Fresnel term 1) reflects by one bounce: of simulated surfaces, and
/// of the lobe that the kernels shade with, Beckmann's with height-correlated Smith masking.
struct MirrorAlbedo {
  // Ascending; warped, from 0 to 1: t = mu (1 + s) / (mu + s), s = MS_WARP alpha, of the cosine mu.
  std::vector<double> alphas, warped;
  std::vector<double> simulated, lobe;  // alphas x warped

  /// Bilinear in alpha and warped cosine, which are clamped to the table.
  double at(const std::vector<double>& energy, double alpha, double t) const;
  static double warp(double alpha, double mu);
  static double cosine(double alpha, double t);  // inverse of warp()
};

struct MultiscatterData {
  LobePolynomials refit;  // without masking
  EonRoughness eon;
  ScatterFit fitted;  // the reciprocal model
  MirrorAlbedo mirror;
  std::string source;  // how the figures were made, one sentence
};

std::string toJson(const MultiscatterData& data);
/// Throws Error naming the file: not JSON, keys missing, wrong sizes, values out of range.
MultiscatterData readMultiscatterData(const std::filesystem::path& path);
/// The project's, read once.
const MultiscatterData& multiscatterData();

}  // namespace glintmark
