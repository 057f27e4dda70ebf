// How far a table of linearly transformed cosines is from the BRDF it stands for.
#pragma once
#include <filesystem>
#include <vector>

#include "host/fit/ltc_table.h"

namespace glintmark {

/// Integral over the hemisphere of |scale lobe - BRDF cosine| at F0 = 1, for one matrix and scale
/// of `cell`; alpha > 0, cos_theta in [0, 1]. By cubature, good to about 1 %.
double ltcCellError(reference::Ndf ndf, const LtcCell& cell, double alpha, double cos_theta);

/// That error at points of a table.
struct LtcErrors {
  int width = 0, height = 0;
  std::vector<double> values;  // row by row as in the table

  double at(int x, int y) const { return values[static_cast<std::size_t>(y) * width + x]; }
  double mean() const;
  double max() const;
};

/// Errors at the nodes, size x size; the first column at ltcFitAlpha(0). Parallel.
LtcErrors ltcNodeErrors(const LtcTable& table);

/// Errors of bilinear interpolation in the middle between four nodes, (size - 1) x (size - 1).
LtcErrors ltcMidpointErrors(const LtcTable& table);

/// Reads the table that accompanies [HH16], `ltc.mat`: matrices M and magnitudes in Octave's text
/// format, GGX. Its magnitudes are albedos; Schlick terms are not in it and become 0. Throws Error
/// naming the file if it is anything else.
LtcTable readPublishedLtc(const std::filesystem::path& path);

}  // namespace glintmark
