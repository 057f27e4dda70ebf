// Ground truths by supersampling (truth.cl) against sums in double precision over each pixel, over
// cones of light and over polygon lights.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "host/core/angles.h"
#include "host/frame/ground_truth.h"
#include "host/harness/small_scenes.h"
#include "host/reference/beckmann.h"
#include "host/reference/light_cone.h"
#include "host/reference/microfacet.h"
#include "host/verify/check_frames.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kTruthSize_px = 12, kSpp = 1024;
// Samples of normals and cones are spread evenly, so a pixel's mean is good to 1 %; those of area
// lights are random and weighted, good to some 2 %, and worst of 144. The mean of all pixels has a
// tenth of it, unless something is missing.
constexpr double kPixelNoise = 0.04, kWeightedNoise = 0.1, kMeanNoise = 0.005;
// A frame of one normal is exact, but for single precision and the sum over the lamp below.
constexpr double kFrameNoise = 0.005;
constexpr int kTruthDirections = 2000, kLightSteps = 48, kSubpixels = 12;

glm::dvec3 rgbOf(const float4& v) {
  return {v.x, v.y, v.z};
}

// A direction in the floor's tangent frame: z up, x along u, y along v.
glm::dvec3 onFloor(const glm::dvec3& w) {
  return {w.x, -w.z, w.y};
}

Scene truthFloor() {
  Scene scene = floorScene();
  scene.materials[0].has_glints = false;
  SurfaceMaterial& surface = scene.materials[0].params.surface;
  surface.alpha_g = {0.35f, 0.35f};
  surface.f0 = {0.04f, 0.5f, 0.9f, 0};
  surface.albedo = {0.5f, 0.3f, 0.2f, 0};
  surface.intensity = 0.8f;
  scene.lights.clear();
  return scene;
}

ConeLight coneOver(const glm::dvec3& direction, double half_deg) {
  ConeLight light{};
  const glm::dvec3 d = glm::normalize(direction);
  light.direction = {static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z),
                     static_cast<float>(half_deg * kDegree)};
  light.irradiance = {1, 2, 3, 0};
  return light;
}

// Where a ray meets the floor.
glm::dvec3 floorPoint(const Camera& camera, double x, double y) {
  const glm::dvec3 ray = camera.ray(x, y);
  return camera.eye - ray * (camera.eye.y / ray.y);
}

using Radiance = std::function<glm::dvec3(const Camera&, double x, double y)>;

// Every pixel of the truth, and their mean, against `want` at a place on the screen.
void compare(const CheckContext& context, Finding& finding, const Scene& scene, const View& view,
             double noise, const Radiance& want) {
  const ShadingOptions options{
      .width_px = kTruthSize_px, .height_px = kTruthSize_px, .lanes = context.lanes};
  const Image truth = renderTruth(context.bench.device, scene, view, options, kSpp, {}, 1).mean;
  const Camera camera = makeCamera(view, kTruthSize_px, kTruthSize_px);
  glm::dvec3 got_sum(0), want_sum(0);
  for (int y = 0; y < kTruthSize_px; ++y)
    for (int x = 0; x < kTruthSize_px; ++x) {
      const glm::dvec3 expected = want(camera, x, y);
      for (int c = 0; c < 3; ++c) {
        const double got = truth.at(x, y)[static_cast<std::size_t>(c)];
        finding.add(std::abs(got / expected[c] - 1) / noise);
        got_sum[c] += got;
      }
      want_sum += expected;
    }
  for (int c = 0; c < 3; ++c) finding.add(std::abs(got_sum[c] / want_sum[c] - 1) / kMeanNoise);
}

reference::CoatedDiffuse coatOf(const Material& material) {
  const SurfaceMaterial& surface = material.params.surface;
  return {material.ggx ? reference::Ndf::kGgx : reference::Ndf::kBeckmann, surface.alpha_g.x,
          rgbOf(surface.f0), surface.intensity};
}

glm::dvec3 shadeCones(const Scene& scene, const reference::CoatedDiffuse& coat, const glm::dvec3& n,
                      const glm::dvec3& view, int directions) {
  const SurfaceMaterial& surface = scene.materials[0].params.surface;
  const glm::dvec3 t = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), n)), b = glm::cross(n, t);
  const auto local = [&](const glm::dvec3& w) {
    return glm::dvec3(glm::dot(t, w), glm::dot(b, w), glm::dot(n, w));
  };
  const glm::dvec2 alpha(surface.alpha_g.x, surface.alpha_g.y);
  glm::dvec3 sum(0);
  for (const ConeLight& light : scene.lights) {
    const reference::Cone cone = {local(onFloor(glm::normalize(rgbOf(light.direction)))),
                                  light.direction.w};
    const glm::dvec3 lambert = cone.half_angle_rad > 0
                                   ? glm::dvec3(reference::coneDiffuse(cone, directions))
                                   : glm::dvec3(std::max(cone.axis.z, 0.0) / kPi);
    sum += rgbOf(light.irradiance) *
           (static_cast<double>(surface.intensity) *
                reference::coneRadiance(cone, local(view), alpha, rgbOf(surface.f0), directions) +
            rgbOf(surface.albedo) * coat.share(local(view).z) * lambert);
  }
  return sum;
}

// Lights on either side of the world's plane z = 0, where their frames change sign.
Finding coneTruth(const CheckContext& context) {
  Finding finding(1);
  for (const double z : {-0.6, 0.6}) {
    Scene scene = truthFloor();
    scene.lights = {coneOver({0.6, 0.7, z}, 12)};
    const reference::CoatedDiffuse coat = coatOf(scene.materials[0]);
    compare(context, finding, scene, lookingDown(40), kPixelNoise,
            [&](const Camera& camera, double x, double y) {
              return shadeCones(scene, coat, {0, 0, 1}, onFloor(-glm::normalize(camera.ray(x, y))),
                                kTruthDirections);
            });
  }
  return finding;
}

// A map whose texels are about a pixel: the mean over the pixel of the interpolated normals.
Finding mappedTruth(const CheckContext& context) {
  constexpr int kTexels = 32;
  NormalMap map;
  map.name = "waves";
  map.width_px = map.height_px = kTexels;
  for (int y = 0; y < kTexels; ++y)
    for (int x = 0; x < kTexels; ++x)
      map.normals.push_back(glm::normalize(
          glm::vec3(0.3f * std::sin(1.9f * static_cast<float>(x) + 0.7f * static_cast<float>(y)),
                    0.25f * std::cos(1.3f * static_cast<float>(y)) + 0.1f, 1)));
  Scene scene = truthFloor();
  scene.lights = {coneOver({0.4, 0.7, -0.5}, 0), coneOver({-0.5, 0.6, 0.3}, 0)};
  scene.materials[0].normal_map = {std::make_shared<const NormalMap>(map), 1};
  const auto normalAt = [&](double u, double v) {
    const double x = u * kTexels - 0.5, y = v * kTexels - 0.5;
    const double fx = x - std::floor(x), fy = y - std::floor(y);
    glm::dvec3 sum(0);
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) {
        const auto wrap = [&](double at) {
          return ((static_cast<int>(at) % kTexels) + kTexels) % kTexels;
        };
        sum += (i ? fx : 1 - fx) * (j ? fy : 1 - fy) *
               glm::dvec3(map.at(wrap(std::floor(x) + i), wrap(std::floor(y) + j)));
      }
    return glm::normalize(sum);
  };
  const reference::CoatedDiffuse coat = coatOf(scene.materials[0]);
  Finding finding(1);
  compare(context, finding, scene, lookingDown(35, 1), kPixelNoise,
          [&](const Camera& camera, double px, double py) {
            glm::dvec3 sum(0);
            for (int j = 0; j < kSubpixels; ++j)
              for (int i = 0; i < kSubpixels; ++i) {
                const double x = px - 0.5 + (i + 0.5) / kSubpixels,
                             y = py - 0.5 + (j + 0.5) / kSubpixels;
                const glm::dvec3 p = floorPoint(camera, x, y);
                sum += shadeCones(scene, coat, normalAt(p.x, -p.z),
                                  onFloor(-glm::normalize(camera.ray(x, y))), 1);
              }
            return sum / static_cast<double>(kSubpixels * kSubpixels);
          });
  return finding;
}

// A light that hangs over the floor, one that stands in it and is cut by the horizon.
Finding areaTruth(const CheckContext& context, bool ggx) {
  const reference::Ndf ndf = ggx ? reference::Ndf::kGgx : reference::Ndf::kBeckmann;
  Scene scene = truthFloor();
  scene.materials[0].ggx = ggx;
  scene.materials[0].params.surface.alpha_g = {0.6f, 0.6f};
  AreaLight above, standing;
  above.vertices = {{-0.7, 1, -0.9}, {0.8, 1, -0.9}, {0.8, 1.4, 0.3}, {-0.7, 1.4, 0.3}};
  standing.vertices = {{1, -0.6, -1}, {1, -0.6, 1}, {1, 0.9, 1}, {1, 0.9, -1}};
  above.radiance = {1, 2, 3};
  standing.radiance = {2, 1, 0.5};
  above.two_sided = standing.two_sided = true;
  scene.area_lights = {above, standing};
  const SurfaceMaterial& surface = scene.materials[0].params.surface;
  const reference::CoatedDiffuse coat = coatOf(scene.materials[0]);
  Finding finding(1);
  compare(context, finding, scene, lookingDown(30, 2), kWeightedNoise,
          [&](const Camera& camera, double x, double y) {
            const glm::dvec3 point = floorPoint(camera, x, y);
            const glm::dvec3 view = onFloor(-glm::normalize(camera.ray(x, y)));
            glm::dvec3 sum(0);
            for (const AreaLight& light : scene.area_lights) {
              const glm::dvec3 along_u = light.vertices[1] - light.vertices[0],
                               along_v = light.vertices[3] - light.vertices[0];
              const glm::dvec3 normal = glm::cross(along_u, along_v);
              for (int i = 0; i < kLightSteps; ++i)
                for (int j = 0; j < kLightSteps; ++j) {
                  const glm::dvec3 d = light.vertices[0] + (i + 0.5) / kLightSteps * along_u +
                                       (j + 0.5) / kLightSteps * along_v - point;
                  const double length = glm::length(d);
                  const glm::dvec3 l = onFloor(d / length);
                  if (l.z <= 0) continue;
                  const double angle = std::abs(glm::dot(normal, d)) / std::pow(length, 3) /
                                       (kLightSteps * kLightSteps);
                  const glm::dvec3 fresnel =
                      reference::schlick(rgbOf(surface.f0), glm::dot(l, glm::normalize(l + view)));
                  sum += light.radiance * angle *
                         (static_cast<double>(surface.intensity) * fresnel *
                              reference::microfacetTimesCosine(ndf, l, view, surface.alpha_g.x) +
                          rgbOf(surface.albedo) * coat.share(view.z) * l.z / kPi);
                }
            }
            return sum;
          });
  return finding;
}

// Normals that all lean away from the eye of lookingDown(), by 50 degrees.
NormalMap leaningMap() {
  NormalMap map;
  map.name = "leaning";
  map.width_px = map.height_px = 4;
  const auto lean = static_cast<float>(50 * kDegree);
  map.normals.assign(16, {0, std::sin(lean), std::cos(lean)});
  return map;
}

// The diffuse light of a lamp that faces the normal `n`, floor's frame, point by point.
double lambertOf(const AreaLight& lamp, const glm::dvec3& point, const glm::dvec3& n) {
  const glm::dvec3 along_u = lamp.vertices[1] - lamp.vertices[0],
                   along_v = lamp.vertices[3] - lamp.vertices[0];
  double sum = 0;
  for (int i = 0; i < kLightSteps; ++i)
    for (int j = 0; j < kLightSteps; ++j) {
      const glm::dvec3 d = lamp.vertices[0] + (i + 0.5) / kLightSteps * along_u +
                           (j + 0.5) / kLightSteps * along_v - point;
      const double facing = glm::dot(onFloor(d), n);
      if (facing > 0)
        sum += facing * std::abs(glm::dot(glm::cross(along_u, along_v), d)) /
               std::pow(glm::length(d), 4);
    }
  return sum / (kPi * kLightSteps * kLightSteps);
}

// kernels/README.md, "Normals that turn away": from the eye, a normal mirrors nothing and scatters
// diffuse light all the same; light reaches whichever normals face it, from behind the mesh too.
// Frame and truth against Lambert's term alone, with what the lobe leaves of it at the horizon.
Finding turnedNormals(const CheckContext& context, bool behind_mesh, bool area) {
  Scene scene = truthFloor();
  SurfaceMaterial& surface = scene.materials[0].params.surface;
  // A dim lobe leaves most of the light to the layer, whatever the error of its albedo.
  surface.intensity = behind_mesh ? 0.0f : 0.2f;
  const NormalMap map = leaningMap();
  const glm::dvec3 n = map.normals.front();
  scene.materials[0].normal_map = {std::make_shared<const NormalMap>(map), 1};
  AreaLight lamp;
  const double low = behind_mesh ? -3.2 : 0.5;
  lamp.vertices = {{-1, low, -5}, {1, low, -5}, {1, low + 2, -5}, {-1, low + 2, -5}};
  lamp.radiance = {1, 2, 3};
  lamp.two_sided = true;
  const ConeLight sun = coneOver({0.2, behind_mesh ? -0.3 : 0.4, -1}, 0);
  if (area)
    scene.area_lights = {lamp};
  else
    scene.lights = {sun};
  const View view = lookingDown(behind_mesh ? 60 : 20, 2);
  const reference::CoatedDiffuse coat = coatOf(scene.materials[0]);
  const Radiance want = [&](const Camera& camera, double x, double y) {
    const double light = area ? lambertOf(lamp, floorPoint(camera, x, y), n)
                              : glm::dot(n, onFloor(glm::normalize(rgbOf(sun.direction)))) / kPi;
    const double seen = glm::dot(n, onFloor(-glm::normalize(camera.ray(x, y))));
    return light * coat.share(seen) * rgbOf(surface.albedo) *
           (area ? lamp.radiance : rgbOf(sun.irradiance));
  };
  Finding finding(1);
  compare(context, finding, scene, view, kWeightedNoise, want);
  const ShadingOptions options{
      .width_px = kTruthSize_px, .height_px = kTruthSize_px, .lanes = context.lanes};
  const Image frame = checkFrame(context, scene, view, options);
  const Camera camera = makeCamera(view, kTruthSize_px, kTruthSize_px);
  for (int y = 0; y < kTruthSize_px; ++y)
    for (int x = 0; x < kTruthSize_px; ++x)
      for (int c = 0; c < 3; ++c)
        finding.add(
            std::abs(frame.at(x, y)[static_cast<std::size_t>(c)] / want(camera, x, y)[c] - 1) /
            kFrameNoise);
  return finding;
}

}  // namespace

std::vector<Check> truthChecks() {
  return {{"truth/cones", "error in units of its bound", coneTruth},
          {"truth/mapped_normals", "error in units of its bound", mappedTruth},
          {"truth/area_lights_ggx", "error in units of its bound",
           [](const CheckContext& context) { return areaTruth(context, true); }},
          {"truth/area_lights_beckmann", "error in units of its bound",
           [](const CheckContext& context) { return areaTruth(context, false); }},
          {"truth/turned_from_eye", "error in units of its bound",
           [](const CheckContext& context) { return turnedNormals(context, false, false); }},
          {"truth/turned_from_eye_area", "error in units of its bound",
           [](const CheckContext& context) { return turnedNormals(context, false, true); }},
          {"truth/lights_behind_the_mesh", "error in units of its bound",
           [](const CheckContext& context) { return turnedNormals(context, true, false); }},
          {"truth/area_lights_behind_the_mesh", "error in units of its bound",
           [](const CheckContext& context) { return turnedNormals(context, true, true); }}};
}

}  // namespace glintmark
