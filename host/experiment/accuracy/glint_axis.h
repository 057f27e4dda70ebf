// Pixels over which methods of glints are compared: how many microdetails of one reflect, and how
// long it is on the texture.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/core/shared_types.h"
#include "host/microdetail/microdetail_truth.h"
#include "host/microdetail/pixel_lattice.h"

namespace glintmark {

/// Pixels of one kind: `aspect` is the footprint's long over its short side, `lambda` the mean
/// number of microdetails that reflect in it, `micro` the roughness of one over that of all.
struct GlintStage {
  double aspect = 1, lambda = 1, micro = 0.1;
  /// Of the one stage whose pixels are smaller than a microdetail.
  bool isNear() const { return micro != GlintStage().micro; }
};

/// aspect 1, 4, 16, each with lambda from 0.1 to 1000; last the near one, a tenth of a microdetail
/// a pixel, each of which reflects one time in five.
std::vector<GlintStage> glintStages();

/// "aspect=4/lambda=0.5" behind the name of a setting's case, "micro" too of the near stage; and
/// back: the number of the stage in glintStages().
std::string glintStageCase(const std::string& case_name, const GlintStage& stage);
std::size_t glintStageOf(const std::string& case_name);

/// A lattice is drawn so often, turned and moved each time: replicates that know nothing of each
/// other, from whose spread standard errors come.
inline constexpr int kGlintReplicates = 8;
/// Steps of a zoom by two, over which the size of a pixel's cells goes through all that it can be.
inline constexpr int kGlintZoomSteps = 16;

/// Of all stages: the roughness of the surface, and a half vector off its normal.
inline constexpr double kGlintAlpha = 0.3;
inline const glm::dvec2 kGlintHalfSlope = {0.12, 0.09};
/// The light, and its probability to be reflected by a microdetail.
LightSlopes glintLight(const GlintStage& stage);

/// Lattices of `side` x `side` pixels. While the view zooms, the density follows, so that `lambda`
/// stays: the truth is the same all the way, and what changes is the method's.
PixelLattice glintLattice(const GlintStage& stage, int replicate, int zoom_step, int side);
MaterialParams glintMaterial(const GlintStage& stage, int zoom_step);
/// Pixels along x and y that a replicate moves by for GlintStatistics::change.
glm::dvec2 glintMotion(int replicate);

}  // namespace glintmark
