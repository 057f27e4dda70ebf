// Random rough surfaces on the device.
#pragma once
#include <cstdint>
#include <vector>

#include "host/ocl/compute.h"

namespace glintmark {

/// Moments of the facets' slopes of one surface, over both triangles of every cell, for
/// roughness 1.
struct SlopeMoments {
  double variance_x = 0, variance_y = 0, covariance = 0;  // nominally 1/2, 1/2, 0
  double kurtosis_x = 0;                                  // nominally 3
};

/// Draws surfaces of one kind after another into the same buffers.
class SurfaceMaker {
 public:
  /// `correlation_texels`: see makeSurfaceSpectrum, which throws for it.
  SurfaceMaker(Device& device, ProgramCache& cache, double correlation_texels);

  /// Draws the surface of this seed, with cones for rays above it or, `both_sides`, also below;
  /// returns the time of the kernels [ns].
  double draw(std::uint32_t seed, bool both_sides = true);

  const Buffer& heights() const { return heights_; }   // packed, HF_HEIGHT_WORDS
  const Buffer& cones() const { return cones_; }       // above, then below: 2 HF_OCTANTS maps
  float countHeight() const { return count_height_; }  // [texels] at roughness 1

  /// Heights of the last surface [counts], HF_TILE x HF_TILE, row by row.
  std::vector<std::int32_t> readCounts() const;

 private:
  float count_height_ = 0;
  Kernel draw_modes_, sum_columns_, sum_rows_, pack_heights_, block_tops_, block_cones_;
  Buffer amplitudes_, modes_, cosines_, sines_, columns_, counts_, heights_, tops_, highest_,
      reached_, cones_;
};

/// Measured over the facets of a surface from SurfaceMaker::readCounts.
SlopeMoments slopeMoments(const std::vector<std::int32_t>& counts, double count_height);

}  // namespace glintmark
