// Mip chains of Gaussian mixtures of normals, aligned between neighbours. [TAN05] Sect. 4.1
//
// Domain: unit normals projected onto the tangent plane, (nx, ny). A lobe is an isotropic Gaussian
// of weight a, mean (x, y) and variance s^2 per axis; its mean squared length is
// 2 s^2 + |mean|^2. The paper stores a (s^2 + |mean|^2), which is a second moment in one dimension
// only; here the fourth number is the true one in two, so that what a linear filter mixes is exact.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "host/filter/mip_texels.h"
#include "host/filter/normal_map.h"

namespace glintmark {

struct NormalLobe {
  float weight = 0;      // a, [0, 1]; the weights of a texel add up to 1
  glm::vec2 mean{0, 0};  // inside the unit disk
  float variance = 0;    // s^2, per axis, >= 0
};

/// Moments of a lobe as stored: (a, a mean.x, a mean.y, a (2 s^2 + |mean|^2)). Linear: the moments
/// of mixed samples are the mixture of the moments.
float4 lobeMoments(const NormalLobe& lobe);

/// Inverse of lobeMoments: the closed-form interpolation of [TAN05] Sect. 4.2. A weight of 0 or
/// less gives a lobe of zeros; a variance below 0 by rounding becomes 0.
NormalLobe lobeFromMoments(const float4& moments);

/// In which order the texels of a level see their neighbours.
enum class MixtureOrder {
  kColours,     // four interleaved grids one after the other, each of them in parallel
  kScanline,    // the paper's: row by row, each texel after its left neighbour
  kIndependent  // no neighbours at all: unaligned mixtures, to compare with
};

/// Which normals are under a texel.
enum class MixtureSurface {
  kInterpolated,  // from the second level on what lies between the map's texels as well
  kTexels         // those of the map's texels: as if each were flat
};

struct MixtureOptions {
  int lobes = 4;  // 1..kMaxLobes
  MixtureSurface surface = MixtureSurface::kTexels;
  MixtureOrder order = MixtureOrder::kColours;
  int passes = 2;           // over the chain, coarse to fine, >= 1; later ones see finer texels too
  int sweeps = 1;           // over each level within a pass, >= 1
  int max_iterations = 4;   // EM steps of a texel in a sweep, >= 1; the coarsest level has more
  float tolerance = 2e-3f;  // converged when no weight or mean moves further in a step, > 0
  float prior_weight = 1;   // the paper's C, >= 0
  int threads = 0;          // 0: all cores
};

/// Throws Error for an option out of the ranges above.
void checkMixtureOptions(const MixtureOptions& options);

struct MixtureLevelReport {
  int width_px = 0, height_px = 0;
  double mean_iterations = 0;  // per texel, over all sweeps and passes
  double converged_share = 0;  // of texels in the last sweep
  double log_likelihood = 0;   // mean over the finest normals, of density per unit area
};

/// The chain of mixtures and how the fit went.
struct NormalMixtures {
  MipTexels moments;  // `lobes` float4 a texel, lobeMoments of lobe 0, 1, ...
  int lobes = 0;
  double fit_ms = 0;
  std::vector<MixtureLevelReport> levels;  // finest first

  NormalLobe lobe(int level, int x, int y, int index) const {
    return lobeFromMoments(moments.at(level, x, y)[index]);
  }
};

/// Bytes that the fit to a map of so many texels takes beside the map.
std::uint64_t mixtureFitBytes(int width_px, int height_px, const MixtureOptions& options);

/// Fits mixtures to the finest normals under every texel of every level. First and second moments
/// of each texel's mixture are those of its normals; the neighbour prior decides only how normals
/// are shared among the lobes. Same bits for any number of threads. `progress` is called with the
/// share done in [0, 1] from any thread. Throws Error for options out of range or a bad map.
NormalMixtures fitNormalMixtures(const NormalMap& map, const MixtureOptions& options = {},
                                 const std::function<void(double)>& progress = {});

/// "colours", "scanline" or "independent"; throws Error listing them.
MixtureOrder parseMixtureOrder(const std::string& name);
std::string mixtureOrderName(MixtureOrder order);

}  // namespace glintmark
