// What the diffuse layer gets under a specular lobe: both together return all of the light, where
// nothing is absorbed, and never more.
#include <cmath>

#include "host/frame/white_furnace.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

Material whiteCoat(double alpha, double f0, bool ggx) {
  Material material;
  material.name = "white";
  material.has_glints = false;
  material.ggx = ggx;
  const auto a = static_cast<float>(alpha), f = static_cast<float>(f0);
  SurfaceMaterial& surface = material.params.surface;
  surface.alpha_g = material.params.glints.alpha_l = {a, a};
  surface.f0 = {f, f, f, 0};
  surface.albedo = {1, 1, 1, 0};
  surface.intensity = 1;
  return material;
}

// A furnace whose light is summed up from the kernels' own radiance under 4096 directions, at
// views from the normal to the horizon.
Finding furnace(const CheckContext& context, bool ggx, DiffuseModel model) {
  Finding finding(kCouplingTolerance);
  for (const double f0 : {0.04, 0.5})
    for (const double alpha : {0.05, 0.3, 0.7, 1.0})
      for (const double mu : {1.0, 0.6, 0.3, 0.1, 0.02}) {
        Material material = whiteCoat(alpha, f0, ggx);
        material.diffuse_model = model;
        material.diffuse_roughness = 0.5;
        finding.add(std::abs(whiteFurnace(context.bench.device, material, mu, context.lanes) - 1));
      }
  return finding;
}

}  // namespace

std::vector<Check> couplingChecks() {
  const auto of = [](bool ggx, DiffuseModel model) {
    return [=](const CheckContext& context) { return furnace(context, ggx, model); };
  };
  const char* measure = "light of a white furnace that is lost or made";
  return {{"coupling/beckmann", measure, of(false, DiffuseModel::kLambert)},
          {"coupling/ggx", measure, of(true, DiffuseModel::kLambert)},
          {"coupling/eon", measure, of(false, DiffuseModel::kEon)}};
}

}  // namespace glintmark
