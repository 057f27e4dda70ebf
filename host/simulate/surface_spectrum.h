// Which waves a random rough surface is made of.
#pragma once
#include <vector>

#include "host/core/shared_types.h"

namespace glintmark {

/// Waves of kernels/scatter/height_surface.cl.
struct SurfaceSpectrum {
  std::vector<float> amplitudes;  // HF_MODES x HF_MODE_ROWS, [texels]
  double height_deviation = 0;    // standard deviation of heights [texels]
  double kurtosis_excess = 0;     // of the facets' slopes; 0 for a Gaussian
};

/// Gaussian height correlation exp(-d^2 / (2 l^2)) with l = `correlation_texels`, 1.5 to 8, for
/// slopes of Beckmann roughness 1. A texture of samples is smoother than what it samples: it is the
/// flat triangles between the samples whose slopes must have variance 1/2 along x and along y and
/// no covariance, so amplitudes and axes of the correlation are corrected until they do, exactly.
/// Throws Error for a length out of range.
SurfaceSpectrum makeSurfaceSpectrum(double correlation_texels);

}  // namespace glintmark
