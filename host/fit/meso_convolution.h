// Spherical convolution of two scaled cosine lobes, [TAO21] Eq. 6, and the lobe closest to it.
#pragma once
#include <vector>

namespace glintmark {

/// Convolutions of lobes from a list of roughnesses, each at least kLeastAlpha.
class MesoConvolution {
 public:
  static constexpr double kLeastAlpha = 0.03;  // narrower lobes need more harmonics than are kept

  /// Throws Error if a roughness is outside [kLeastAlpha, 1].
  explicit MesoConvolution(std::vector<double> alphas);

  /// Density per solid angle of the convolution of lobes i and j at angle_rad from the axis. By
  /// Legendre series: convolving zonal functions multiplies their coefficients.
  double density(int i, int j, double angle_rad) const;

  /// The scaled cosine closest to the convolution of lobes i and j in the integral of the absolute
  /// difference over the sphere, which bounds the difference in what any light adds.
  struct Closest {
    double alpha = 0, difference = 0;
  };
  Closest closest(int i, int j) const;

 private:
  std::vector<double> alphas_;
  std::vector<std::vector<double>> coefficients_;  // per lobe
  std::vector<double> cosine_, weight_;            // cubature over the sphere
  std::vector<double> legendre_;                   // P_l at every node, degree by degree
};

}  // namespace glintmark
