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
/// number of microdetails that reflect in it.
struct GlintStage {
  double aspect = 1, lambda = 1;
};

/// aspect 1, 4, 16, each with lambda from 0.1 to 1000.
std::vector<GlintStage> glintStages();

/// "aspect=4/lambda=0.5" behind the name of a setting's case, and back: the number of the stage in
/// glintStages().
std::string glintStageCase(const std::string& case_name, const GlintStage& stage);
std::size_t glintStageOf(const std::string& case_name);

/// A lattice is drawn so often, turned and moved each time: replicates that know nothing of each
/// other, from whose spread standard errors come.
inline constexpr int kGlintReplicates = 8;
/// Steps of a zoom by two, over which the size of a pixel's cells goes through all that it can be.
inline constexpr int kGlintZoomSteps = 16;

/// Of all stages: roughness 0.3, of one microdetail 0.03, and a half vector off the normal.
inline constexpr double kGlintAlpha = 0.3, kGlintAlphaDetail = 0.03;
inline const glm::dvec2 kGlintHalfSlope = {0.12, 0.09};
/// The light and its probability to be reflected by a microdetail.
LightSlopes glintLight();

/// Lattices of `side` x `side` pixels. While the view zooms, the density follows, so that `lambda`
/// stays: the truth is the same all the way, and what changes is the method's.
PixelLattice glintLattice(const GlintStage& stage, int replicate, int zoom_step, int side);
MaterialParams glintMaterial(const GlintStage& stage, int zoom_step);
/// Pixels along x and y that a replicate moves by for GlintStatistics::change.
glm::dvec2 glintMotion(int replicate);

}  // namespace glintmark
