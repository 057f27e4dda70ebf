// Filtering of mip-mapped textures in double precision: kernels/normals/texture.clh.
#pragma once
#include <glm/glm.hpp>
#include <vector>

namespace glintmark::reference {

/// One level, row by row; every texel has the same number of values.
struct TextureLevel {
  int width = 0, height = 0;
  std::vector<std::vector<double>> texels;
};

/// Derivatives of uv along the screen, uv per pixel.
struct UvDerivatives {
  glm::dvec2 dx{}, dy{};
};

/// Probes at first + i along + j across [uv], i below count and j below rows, all at one level.
struct ProbeGrid {
  glm::dvec2 first{}, along{}, across{};
  int count = 1, rows = 1;
  double level = 0;
  double margin = 1;  // how near a count or the choice of directions was to being another
};

/// Most probes along a footprint, most rows across (all of them up to twice as long as wide), and
/// how wide probes in rows are at least, in units of sqrt(3) texels.
struct ProbeLimits {
  int count = 1, rows = 1;
  double least_texels = 1;
};

/// Probes of a footprint: the singular values of the derivatives in texels are its axes. A probe is
/// as wide as the minor axis over the most rows within these limits, but at least as the major one
/// over the most probes and as sqrt(3) texels; the level is the logarithm of its width over
/// sqrt(3). The variance of a row's probes and a probe's own are together that of a box as long as
/// the major axis, the same of rows and the minor axis, unless one probe is wider than the axis.
/// Rows are turned from the axes to the derivatives' own directions if those are close to upright.
ProbeGrid footprintProbes(int width, int height, int level_count, const glm::dvec2& uv,
                          const UvDerivatives& derivatives, const ProbeLimits& most);

/// Mean over the probes of the trilinear texture at each. `repeat` false: the border goes on.
std::vector<double> filterTexture(const std::vector<TextureLevel>& levels, const ProbeGrid& grid,
                                  bool repeat);

}  // namespace glintmark::reference
