// Ground truths of discs, spheres and tubes: Monte Carlo (light_shape_truth.clh) against sums over
// pieces of each light in double precision, pixel by pixel.
#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/frame/ground_truth.h"
#include "host/harness/small_scenes.h"
#include "host/reference/beckmann.h"
#include "host/reference/microfacet.h"
#include "host/reference/round_light.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

using reference::RoundLight;

constexpr int kPictureSize_px = 8, kSamples = 8192, kPieceSteps = 64;
// Samples of lights are random and weighted: good to 1 or 2 % a pixel, and worst of 64; the mean of
// all has an eighth of it, unless something is missing.
constexpr double kWorstPixel = 0.1, kMean = 0.008;

// The floor's tangent frame: z up, x along u, y along v.
glm::dvec3 toFloor(const glm::dvec3& w) {
  return {w.x, -w.z, w.y};
}

AreaLight shapeLight(LightShape shape, const glm::dvec3& centre, const glm::dvec3& axis,
                     double radius, const glm::dvec3& radiance) {
  AreaLight light;
  light.shape = shape;
  light.centre = centre;
  light.axis = axis;
  light.radius = radius;
  light.radiance = radiance;
  return light;
}

struct TruthShape {
  const char* name;
  LightShape shape;
  std::vector<AreaLight> lights;
};

// One that hangs over the floor, and one that the horizon cuts.
const std::vector<TruthShape>& truthShapes() {
  static const std::vector<TruthShape> shapes = [] {
    const glm::dvec3 warm(3, 2, 1), cold(1, 2, 3);
    const auto down = glm::normalize(glm::dvec3(0.2, -1, 0.3));
    const auto level = glm::normalize(glm::dvec3(-1, 0.1, 0.2));
    return std::vector<TruthShape>{
        {"disc",
         LightShape::kDisc,
         {shapeLight(LightShape::kDisc, {-0.3, 1.2, -0.8}, down, 0.6, warm),
          shapeLight(LightShape::kDisc, {1.2, 0.2, -0.2}, level, 0.7, cold)}},
        {"sphere",
         LightShape::kSphere,
         {shapeLight(LightShape::kSphere, {-0.3, 1.2, -0.8}, down, 0.5, warm),
          shapeLight(LightShape::kSphere, {1.6, 0.2, -0.2}, level, 0.5, cold)}},
        {"tube",
         LightShape::kTube,
         {shapeLight(LightShape::kTube, {-1, 1, -1}, {2, 0.3, 0.2}, 0.15, warm),
          shapeLight(LightShape::kTube, {2, -0.5, -0.3}, {0.2, 1.5, 0.1}, 0.25, cold)}}};
  }();
  return shapes;
}

RoundLight seenFrom(const AreaLight& light, const glm::dvec3& point) {
  RoundLight seen;
  seen.shape = light.shape == LightShape::kDisc     ? RoundLight::Shape::kDisc
               : light.shape == LightShape::kSphere ? RoundLight::Shape::kSphere
                                                    : RoundLight::Shape::kTube;
  seen.centre = toFloor(light.centre - point);
  seen.axis = toFloor(light.axis);
  seen.radius = light.radius;
  return seen;
}

glm::dvec3 asVector(const float4& v) {
  return {v.x, v.y, v.z};
}

// `coat`: of the floor's lobe over its diffuse layer.
glm::dvec3 wantedRadiance(const Scene& scene, const reference::CoatedDiffuse& coat,
                          const glm::dvec3& point, const glm::dvec3& view) {
  const SurfaceMaterial& surface = scene.materials[0].params.surface;
  const glm::dvec3 diffuse = asVector(surface.albedo) * coat.share(view.z) / kPi;
  glm::dvec3 sum(0);
  for (const AreaLight& light : scene.area_lights)
    for (const reference::LightPiece& piece :
         reference::roundPieces(seenFrom(light, point), kPieceSteps)) {
      const glm::dvec3& l = piece.direction;
      if (l.z <= 0) continue;
      const glm::dvec3 fresnel =
          reference::schlick(asVector(surface.f0), glm::dot(l, glm::normalize(l + view)));
      sum +=
          light.radiance * piece.angle_sr *
          (static_cast<double>(surface.intensity) * fresnel *
               reference::microfacetTimesCosine(reference::Ndf::kGgx, l, view, surface.alpha_g.x) +
           diffuse * l.z);
    }
  return sum;
}

Finding shapeTruth(const CheckContext& context, const TruthShape& kind) {
  Scene scene = floorScene();
  scene.lights.clear();
  scene.area_lights = kind.lights;
  scene.materials[0].has_glints = false;
  scene.materials[0].ggx = true;
  SurfaceMaterial& surface = scene.materials[0].params.surface;
  surface.alpha_g = {0.5f, 0.5f};
  surface.f0 = {0.04f, 0.5f, 0.9f, 0};
  surface.albedo = {0.5f, 0.3f, 0.2f, 0};
  surface.intensity = 0.8f;
  const View view = lookingDown(35, 2);
  const ShadingOptions options{
      .width_px = kPictureSize_px, .height_px = kPictureSize_px, .lanes = context.lanes};
  const Image truth = renderTruth(context.bench.device, scene, view, options, kSamples, {}, 1).mean;
  const Camera camera = makeCamera(view, kPictureSize_px, kPictureSize_px);
  const reference::CoatedDiffuse coat = {reference::Ndf::kGgx, surface.alpha_g.x,
                                         asVector(surface.f0), surface.intensity};
  Finding finding(1);
  glm::dvec3 got_sum(0), want_sum(0);
  for (int y = 0; y < kPictureSize_px; ++y)
    for (int x = 0; x < kPictureSize_px; ++x) {
      const glm::dvec3 ray = camera.ray(x, y);
      const glm::dvec3 want = wantedRadiance(scene, coat, camera.eye - ray * (camera.eye.y / ray.y),
                                             toFloor(-glm::normalize(ray)));
      for (int c = 0; c < 3; ++c) {
        const double got = truth.at(x, y)[static_cast<std::size_t>(c)];
        finding.add(std::abs(got / want[c] - 1) / kWorstPixel);
        got_sum[c] += got;
      }
      want_sum += want;
    }
  for (int c = 0; c < 3; ++c) finding.add(std::abs(got_sum[c] / want_sum[c] - 1) / kMean);
  return finding;
}

}  // namespace

std::vector<Check> shapeTruthChecks() {
  std::vector<Check> checks;
  for (const TruthShape& kind : truthShapes())
    checks.push_back({std::string("area_shape/truth_") + kind.name, "error in units of its bound",
                      [&kind](const CheckContext& context) { return shapeTruth(context, kind); }});
  return checks;
}

}  // namespace glintmark
