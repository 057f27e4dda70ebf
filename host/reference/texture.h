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

/// Probes at first + i step [uv], all at one level.
struct ProbeLine {
  glm::dvec2 first{}, step{};
  int count = 1;
  double level = 0;
  double ratio = 1;  // of the major axis to a probe's width; count is this rounded up
};

/// Probes of a footprint: the singular values of the derivatives in texels are its axes; the minor
/// one, but at least the major one over `most_probes` and sqrt(3) texels, is a probe's width, and
/// the level is the logarithm of that over sqrt(3).
ProbeLine footprintProbes(int width, int height, int level_count, const glm::dvec2& uv,
                          const UvDerivatives& derivatives, int most_probes);

/// Mean over the probes of the trilinear texture at each. `repeat` false: the border goes on.
std::vector<double> filterTexture(const std::vector<TextureLevel>& levels, const ProbeLine& line,
                                  bool repeat);

}  // namespace glintmark::reference
