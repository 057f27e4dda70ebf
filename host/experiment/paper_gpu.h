// The papers' GPUs, and how a device compares with them.
#pragma once

namespace glintmark {

/// GeForce GTX 980: 2048 lanes x 2 x 1.216 GHz boost [GFLOP/s].
inline constexpr double kGtx980PeakGflops = 4980;
/// GeForce GTX 1070: 1920 lanes x 2 x 1.683 GHz boost [GFLOP/s].
inline constexpr double kGtx1070PeakGflops = 6460;

/// Our time over the paper's per unit of peak speed; 1 is as efficient as the paper's GPU.
inline double normalisedCost(double ours_ms, double our_peak_gflops, double paper_ms,
                             double paper_peak_gflops) {
  return ours_ms * our_peak_gflops / (paper_ms * paper_peak_gflops);
}

}  // namespace glintmark
