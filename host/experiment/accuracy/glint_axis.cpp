#include "host/experiment/accuracy/glint_axis.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <random>

#include "host/core/error.h"
#include "host/microdetail/glint_statistics.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

constexpr double kAspects[] = {1, 4, 16};
constexpr double kLambdas[] = {0.1, 0.5, 2, 10, 100, 1000};
constexpr double kLeastPixel_uv = 0x1p-10;  // side of a square pixel before zooming
constexpr double kTexture_uv = 900;         // over which lattices lie

double pixelArea(int zoom_step) {
  return std::pow(kLeastPixel_uv, 2) * std::exp2(2.0 * zoom_step / kGlintZoomSteps);
}

}  // namespace

std::vector<GlintStage> glintStages() {
  std::vector<GlintStage> stages;
  for (const double aspect : kAspects)
    for (const double lambda : kLambdas) stages.push_back({aspect, lambda});
  stages.push_back({1, 0.02, 0.5});
  return stages;
}

std::string glintStageCase(const std::string& case_name, const GlintStage& stage) {
  CaseName name = CaseName::parse(case_name);
  name.knobs.emplace_back("aspect", stage.aspect);
  name.knobs.emplace_back("lambda", stage.lambda);
  if (stage.isNear()) name.knobs.emplace_back("micro", stage.micro);
  return name.text();
}

std::size_t glintStageOf(const std::string& case_name) {
  const CaseName name = CaseName::parse(case_name);
  const std::vector<GlintStage> stages = glintStages();
  for (std::size_t i = 0; i < stages.size(); ++i)
    if (stages[i].aspect == name.number("aspect") && stages[i].lambda == name.number("lambda"))
      return i;
  throw Error(fmt::format("no pixels are of case {}", case_name));
}

LightSlopes glintLight(const GlintStage& stage) {
  return pointSlopes(kGlintHalfSlope, glm::dvec2(kGlintAlpha),
                     glm::dvec2(stage.micro * kGlintAlpha));
}

PixelLattice glintLattice(const GlintStage& stage, int replicate, int zoom_step, int side) {
  std::mt19937 random(static_cast<unsigned>(1000 + replicate));
  std::uniform_real_distribution<double> unit(0, 1);
  const glm::dvec2 centre = kTexture_uv * glm::dvec2(unit(random), unit(random));
  // Angles are spread over half a turn, each by chance within its share.
  const double angle = std::numbers::pi * (replicate + unit(random)) / kGlintReplicates;
  return tiledLattice(centre, pixelArea(zoom_step), stage.aspect, angle, side, side);
}

MaterialParams glintMaterial(const GlintStage& stage, int zoom_step) {
  MaterialParams material{};
  const auto alpha_g = static_cast<float>(kGlintAlpha);
  const auto alpha_l = static_cast<float>(stage.micro * kGlintAlpha);
  material.surface.alpha_g = {alpha_g, alpha_g};
  material.surface.intensity = 1;
  material.surface.f0 = {1, 1, 1, 0};
  material.glints.alpha_l = {alpha_l, alpha_l};
  material.glints.density =
      static_cast<float>(stage.lambda / (glintLight(stage).probability * pixelArea(zoom_step)));
  return material;
}

glm::dvec2 glintMotion(int replicate) {
  return replicate % 2 == 0 ? glm::dvec2(kGlintMotion_px, 0) : glm::dvec2(0, kGlintMotion_px);
}

}  // namespace glintmark
