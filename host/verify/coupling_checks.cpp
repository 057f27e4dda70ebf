// What the diffuse layer gets under a specular lobe: both together return all of the light, where
// nothing is absorbed, and never more.
#include <cmath>
#include <memory>

#include "host/frame/white_furnace.h"
#include "host/harness/area_light_harness.h"
#include "host/harness/specular_cases.h"
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
Finding pointFurnace(const CheckContext& context, bool ggx, DiffuseModel model) {
  Finding finding(kCouplingTolerance);
  for (const double alpha : {0.05, 0.3, 1.0})
    for (const double f0 : {0.04, 0.5})
      for (const double mu : {1.0, 0.3, 0.02}) {
        if (model != DiffuseModel::kLambert && (f0 > 0.04 || alpha < 0.3)) continue;
        Material material = whiteCoat(alpha, f0, ggx);
        material.diffuse_model = model;
        material.diffuse_roughness = 0.5;
        finding.add(std::abs(whiteFurnace(context.bench.device, material, mu, context.lanes) - 1));
      }
  return finding;
}

// Four normals far apart under each pixel, as a mixture: the mean of what their facets return, of
// which some of the light lies below the mesh's horizon.
Finding mappedFurnace(const CheckContext& context) {
  Finding finding(1 + kCouplingTolerance);
  NormalMap map;
  map.name = "facets";
  map.width_px = map.height_px = 2;
  for (const glm::vec2& slope :
       {glm::vec2(0.35f, 0.3f), {-0.4f, 0.25f}, {0.3f, -0.35f}, {-0.3f, -0.3f}})
    map.normals.push_back(glm::normalize(glm::vec3(slope, 1)));
  for (const double f0 : {0.04, 0.5})
    for (const double mu : {1.0, 0.1}) {
      Material material = whiteCoat(0.3, f0, false);
      material.normal_map = {std::make_shared<const NormalMap>(map), 4};
      finding.add(whiteFurnace(context.bench.device, material, mu, context.lanes));
    }
  return finding;
}

// A light that fills the hemisphere.
Finding areaFurnace(const CheckContext& context) {
  Finding finding(kCouplingTolerance);
  AreaLightProbe probe;
  probe.table = shippedGgx();
  probe.width = context.lanes;
  probe.lights = {polygonLight(rectangleVertices({0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {2e5, 2e5}))};
  std::vector<HandMadePoint> points;
  for (const double alpha : {0.05, 0.3, 0.7, 1.0})
    for (const double mu : {1.0, 0.6, 0.3, 0.1, 0.02}) {
      HandMadePoint point;
      point.view = {std::sqrt(1 - mu * mu), 0, mu};
      point.alpha = alpha;
      points.push_back(point);
    }
  probe.material = whiteCoat(0.3, 0.04, true).params;
  probe.material.surface.f0 = {0.04f, 0.5f, 0.9f, 0};
  for (const glm::vec3& value : lightPoints(context.bench, probe, points))
    for (int c = 0; c < 3; ++c) finding.add(std::abs(value[c] - 1));
  return finding;
}

}  // namespace

std::vector<Check> couplingChecks() {
  const auto of = [](bool ggx, DiffuseModel model) {
    return [=](const CheckContext& context) { return pointFurnace(context, ggx, model); };
  };
  const char* measure = "light of a white furnace that is lost or made";
  return {{"coupling/beckmann", measure, of(false, DiffuseModel::kLambert)},
          {"coupling/ggx", measure, of(true, DiffuseModel::kLambert)},
          {"coupling/eon", measure, of(false, DiffuseModel::kEon)},
          {"coupling/fitted", measure, of(false, DiffuseModel::kFitted)},
          {"coupling/mapped", "most that a mapped surface returns", mappedFurnace},
          {"coupling/area", measure, areaFurnace}};
}

}  // namespace glintmark
