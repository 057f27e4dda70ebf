// Mapped normals by every method against brute force: a footprint that holds a whole map shows the
// mean over its normals of the base lobe around each, [TAN05] Eq. 3, with no moments, no mixtures
// and no levels.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "host/core/angles.h"
#include "host/frame/frame_renderer.h"
#include "host/harness/small_scenes.h"
#include "host/harness/tolerances.h"
#include "host/reference/beckmann.h"
#include "host/reference/microfacet.h"
#include "host/reference/normal_lobe.h"
#include "host/verify/check_frames.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kSize_px = 24;
constexpr double kUvPerUnit = 2000;  // hundreds of maps under every pixel

// Of a strip that is shared out among one, four or sixteen slopes. What is interpolated lies
// between two of them, a texel in 256 or fewer.
constexpr int kStrip_px = 4096;

glm::vec3 normalOf(const glm::vec2& slope) {
  return glm::normalize(glm::vec3(slope, 1));
}

NormalMap mapOfSlopes(const std::vector<glm::vec2>& slopes) {
  NormalMap map;
  map.name = "slopes";
  map.width_px = kStrip_px;
  map.height_px = 1;
  for (std::size_t i = 0; i < kStrip_px; ++i)
    map.normals.push_back(normalOf(slopes[i * slopes.size() / kStrip_px]));
  return map;
}

// Four clusters of four each, which four lobes of some variance are.
std::vector<glm::vec2> clusteredSlopes() {
  std::vector<glm::vec2> slopes;
  for (const glm::vec2& centre :
       {glm::vec2(0.35f, 0.3f), {-0.4f, 0.25f}, {0.3f, -0.35f}, {-0.3f, -0.3f}})
    for (const glm::vec2& off :
         {glm::vec2(0.08f, 0.08f), {-0.08f, 0.08f}, {0.08f, -0.08f}, {-0.08f, -0.08f}})
      slopes.push_back(centre + off);
  return slopes;
}

// Four clusters that are rows, each turned otherwise: lobes that are round miss them.
std::vector<glm::vec2> rowsOfSlopes() {
  std::vector<glm::vec2> slopes;
  const glm::vec2 centres[] = {{0.35f, 0.3f}, {-0.4f, 0.25f}, {0.3f, -0.35f}, {-0.3f, -0.3f}};
  const glm::vec2 along[] = {{0.13f, 0}, {0.09f, 0.09f}, {0.09f, -0.09f}, {0, 0.13f}};
  for (int i = 0; i < 4; ++i)
    for (const float step : {-1.3f, -0.4f, 0.4f, 1.3f})
      slopes.push_back(centres[i] + step * along[i]);
  return slopes;
}

Scene floorOf(const NormalMap& map) {
  Scene scene = mappedFloor(map);
  for (auto& uv : scene.mesh.uvs) uv *= static_cast<float>(kUvPerUnit);
  scene.materials[0].params.surface.f0 = {0.04f, 0.5f, 0.9f, 0};
  scene.materials[0].params.surface.albedo = {0.3f, 0.2f, 0.1f, 0};
  return scene;
}

glm::dvec3 rgb(const float4& v) {
  return {v.x, v.y, v.z};
}

// The floor's tangent frame, in which the map stands: z up, x along u, y along v.
glm::dvec3 inFloor(const glm::dvec3& w) {
  return {w.x, -w.z, w.y};
}

// What the surface of normal `n` (tangent space) makes of the scene's lights.
glm::dvec3 shadeNormal(const Scene& scene, const reference::CoatedDiffuse& coat,
                       const glm::dvec3& n, const glm::dvec3& view) {
  const SurfaceMaterial& surface = scene.materials[0].params.surface;
  const glm::dvec3 t = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), n)), b = glm::cross(n, t);
  const auto local = [&](const glm::dvec3& w) {
    return glm::dvec3(glm::dot(t, w), glm::dot(b, w), glm::dot(n, w));
  };
  glm::dvec3 sum(0);
  for (const ConeLight& light : scene.lights) {
    const glm::dvec3 i = local(inFloor(glm::normalize(rgb(light.direction)))), o = local(view);
    const glm::dvec3 specular = reference::brdfTimesCosine(
        i, o, glm::dvec2(surface.alpha_g.x, surface.alpha_g.y), rgb(surface.f0));
    sum +=
        rgb(light.irradiance) * (static_cast<double>(surface.intensity) * specular +
                                 rgb(surface.albedo) * coat.share(o.z) * std::max(i.z, 0.0) / kPi);
  }
  return sum;
}

struct MethodCase {
  const char* name;
  NormalMethod method;
  std::vector<glm::vec2> slopes;  // of the texels
  bool of_mean;                   // the method shows the mean normal alone
  double bound;                   // relative
  bool half = false;
};

// Four normals far apart, which a mixture of four keeps; two clusters along a diagonal; a square,
// whose variance is the same along both axes; one tilted normal.
const std::vector<glm::vec2> kApart = {
    {0.35f, 0.3f}, {-0.4f, 0.25f}, {0.3f, -0.35f}, {-0.3f, -0.3f}};
const std::vector<glm::vec2> kDiagonal = {
    {0.22f, 0.02f}, {0.08f, -0.12f}, {0.18f, -0.02f}, {0.12f, -0.08f}};
const std::vector<glm::vec2> kSquare = {{0.1f, 0.1f}, {-0.1f, 0.1f}, {0.1f, -0.1f}, {-0.1f, -0.1f}};
const std::vector<glm::vec2> kAlongU = {{0.2f, 0}, {0.06f, 0}, {0.17f, 0.01f}, {0.09f, -0.01f}};
const std::vector<glm::vec2> kTilted = {{0.2f, -0.1f}};
// Closer together than the base lobe shows: four lobes become one before they are lanes.
const std::vector<glm::vec2> kClose = {
    {0.25f, -0.1f}, {0.15f, -0.1f}, {0.2f, -0.05f}, {0.2f, -0.15f}};
const std::vector<glm::vec2> kSteep = {{1.4f, 0.2f}, {1.1f, -0.7f}, {0.6f, 0.5f}, {2.2f, 0.1f}};
const std::vector<glm::vec2> kClusters = clusteredSlopes();
const std::vector<glm::vec2> kRows = rowsOfSlopes();

const std::vector<MethodCase>& methodCases() {
  static const std::vector<MethodCase> cases = {
      {"mip_tilted", NormalMethod::kMip, kTilted, false, kTiltedLobe},
      {"mip_mean", NormalMethod::kMip, kDiagonal, true, kTiltedLobe},
      {"fixed_tilted", NormalMethod::kFixed, kTilted, false, kTiltedLobe},
      {"toksvig_tilted", NormalMethod::kToksvig, kTilted, false, kTiltedLobe},
      {"toksvig_square", NormalMethod::kToksvig, kSquare, false, kGaussianOfNormals},
      {"lean_tilted", NormalMethod::kLean, kTilted, false, kTiltedLobe},
      {"lean_diagonal", NormalMethod::kLean, kDiagonal, false, kGaussianOfNormals},
      {"lean_along_u", NormalMethod::kLean, kAlongU, false, kGaussianOfNormals},
      {"fournier_tilted", NormalMethod::kFournier, kTilted, false, kPhongPeaks},
      {"fournier_apart", NormalMethod::kFournier, kApart, false, kPhongPeaks},
      {"vmf_tilted", NormalMethod::kVmf, kTilted, false, kTiltedLobe},
      {"vmf_square", NormalMethod::kVmf, kSquare, false, kGaussianOfNormals},
      {"vmf_lobes_apart", NormalMethod::kVmfLobes, kApart, false, kTiltedLobe},
      {"vmf_lobes_clusters", NormalMethod::kVmfLobes, kClusters, false, kGaussianOfNormals},
      {"anisotropic_apart", NormalMethod::kAnisotropic, kApart, false, kTiltedLobe},
      {"anisotropic_clusters", NormalMethod::kAnisotropic, kClusters, false, kGaussianOfNormals},
      {"anisotropic_rows", NormalMethod::kAnisotropic, kRows, false, kGaussianOfNormals},
      {"gmm_tilted", NormalMethod::kGmm, kTilted, false, kTiltedLobe},
      {"gmm_apart", NormalMethod::kGmm, kApart, false, kTiltedLobe},
      {"gmm_close", NormalMethod::kGmm, kClose, false, kTiltedLobe},
      {"gmm_clusters", NormalMethod::kGmm, kClusters, false, kGaussianOfNormals},
      {"gmm_half", NormalMethod::kGmm, kClusters, false, kGaussianOfNormals, true}};
  return cases;
}

// From above and from 30 degrees. Relative to the pixel, where it is not dark.
Finding methodIsTheMean(const CheckContext& context, const MethodCase& c) {
  const NormalMap map = mapOfSlopes(c.slopes);
  const Scene scene = floorOf(map);
  glm::dvec3 mean(0);
  for (const glm::vec2& slope : c.slopes) mean += glm::dvec3(normalOf(slope));
  ShadingOptions options{.width_px = kSize_px, .height_px = kSize_px, .lanes = context.lanes};
  options.normal_method = c.method;
  options.half_texels = c.half;
  const auto textures = std::make_shared<NormalTextures>(context.bench.device);
  const SurfaceMaterial& surface = scene.materials[0].params.surface;
  const reference::CoatedDiffuse coat(reference::Ndf::kBeckmann, surface.alpha_g.x, rgb(surface.f0),
                                      surface.intensity);
  Finding finding(c.bound);
  for (const double angle_deg : {80.0, 30.0}) {
    FrameRenderer renderer(context.bench.device, scene, lookingDown(angle_deg, 3), options, 1,
                           textures);
    renderer.prepare();
    renderer.shade();
    const Image image = renderer.readRadiance();
    for (int y = 0; y < kSize_px; ++y)
      for (int x = 0; x < kSize_px; ++x) {
        const glm::dvec3 view = inFloor(-glm::normalize(renderer.camera().ray(x, y)));
        glm::dvec3 want(0);
        for (const glm::vec2& slope : c.slopes)
          want += shadeNormal(scene, coat, glm::dvec3(normalOf(slope)), view) /
                  static_cast<double>(c.slopes.size());
        if (c.of_mean) want = shadeNormal(scene, coat, glm::normalize(mean), view);
        for (std::size_t k = 0; k < 3; ++k)
          finding.add(std::abs(image.at(x, y)[k] / want[static_cast<int>(k)] - 1));
      }
  }
  return finding;
}

// Toksvig's lobe of normals that nearly lie in the surface is the one of the literature: its
// Gaussian goes on beyond the rim of the disk, and its cosine is that of the mean normal, as short
// as that is.
Finding toksvigAtTheRim(const CheckContext& context) {
  const NormalMap map = mapOfSlopes(kSteep);
  const Scene scene = floorOf(map);
  glm::dvec3 mean(0);
  for (const glm::vec2& slope : kSteep) mean += glm::dvec3(normalOf(slope)) / double(kSteep.size());
  const double length = glm::length(mean);
  const glm::dvec3 m = mean / length;
  const reference::NormalLobe gaussian = {1, {m.x, m.y}, (1 - length) / length};
  const double on_disk = reference::massOnDisk(gaussian);
  const SurfaceMaterial& surface = scene.materials[0].params.surface;
  const reference::CoatedDiffuse coat(reference::Ndf::kBeckmann, surface.alpha_g.x, rgb(surface.f0),
                                      surface.intensity);
  const auto shaded = [&](const glm::dvec3& view) {
    glm::dvec3 sum(0);
    for (const ConeLight& light : scene.lights) {
      const glm::dvec3 i = inFloor(glm::normalize(rgb(light.direction)));
      const double specular =
          on_disk * reference::shadeLobe(gaussian, i, view, surface.alpha_g.x).specular;
      const double schlick = std::pow(1 - glm::dot(view, glm::normalize(i + view)), 5);
      const glm::dvec3 fresnel = rgb(surface.f0) + (1.0 - rgb(surface.f0)) * schlick;
      sum += rgb(light.irradiance) *
             (static_cast<double>(surface.intensity) * specular * fresnel +
              rgb(surface.albedo) * coat.share(std::max(glm::dot(m, view), 0.0)) *
                  std::max(glm::dot(mean, i), 0.0) / kPi);
    }
    return sum;
  };
  Finding finding(kTiltedLobe);
  finding.require(on_disk < 0.9, "the lobe is not at the rim");
  ShadingOptions options{.width_px = kSize_px, .height_px = kSize_px, .lanes = context.lanes};
  options.normal_method = NormalMethod::kToksvig;
  FrameRenderer renderer(context.bench.device, scene, lookingDown(60, 3), options);
  renderer.prepare();
  renderer.shade();
  const Image image = renderer.readRadiance();
  for (int y = 0; y < kSize_px; ++y)
    for (int x = 0; x < kSize_px; ++x) {
      const glm::dvec3 want = shaded(inFloor(-glm::normalize(renderer.camera().ray(x, y))));
      for (std::size_t k = 0; k < 3; ++k)
        finding.add(std::abs(image.at(x, y)[k] / want[static_cast<int>(k)] - 1));
    }
  return finding;
}

// Lobes stored as halves are those stored as floats, to their 11 bits.
Finding halvesAreFloats(const CheckContext& context) {
  const Scene scene = floorOf(mapOfSlopes(kClusters));
  const auto textures = std::make_shared<NormalTextures>(context.bench.device);
  Image images[2];
  for (const bool half : {false, true}) {
    ShadingOptions options{.width_px = kSize_px, .height_px = kSize_px, .lanes = context.lanes};
    options.half_texels = half;
    images[half ? 1 : 0] = checkFrame(context, scene, lookingDown(50, 3), options, textures);
  }
  Finding finding(2e-3);
  for (std::size_t i = 0; i < images[0].pixels.size(); ++i)
    finding.add(std::abs(images[1].pixels[i] / images[0].pixels[i] - 1));
  return finding;
}

}  // namespace

std::vector<Check> normalMethodChecks() {
  std::vector<Check> checks;
  for (const MethodCase& c : methodCases())
    checks.push_back({std::string("normal_method/") + c.name, "error of the mean over normals",
                      [&c](const CheckContext& context) { return methodIsTheMean(context, c); }});
  checks.push_back(
      {"normal_method/toksvig_at_the_rim", "error of the published lobe", toksvigAtTheRim});
  checks.push_back({"normal_method/halves", "relative difference from floats", halvesAreFloats});
  return checks;
}

}  // namespace glintmark
