// Method leadr against brute force: a Gaussian of slopes, point by point, of which each facet shows
// eye and light what it shows them, with no closed form of what is visible and no abscissas. Only
// Smith's theory itself is shared: 1 + Lambda is the area of all facets that face a direction over
// that of their mean plane.
#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/frame/frame_renderer.h"
#include "host/harness/small_scenes.h"
#include "host/harness/tolerances.h"
#include "host/reference/beckmann.h"
#include "host/reference/microfacet.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kFacetFrame_px = 24;
constexpr double kFacetMaps = 2000;   // hundreds of maps under every pixel
constexpr int kFacetStrip_px = 4096;  // shared out among a few slopes; few texels lie between two
constexpr int kSlopeSteps = 121;      // a side of the grid over a Gaussian
constexpr double kSlopeReach = 5;     // deviations

struct SlopeMoments {
  glm::dvec2 mean{0, 0};
  double xx = 0, xy = 0, yy = 0;
};

SlopeMoments slopeMoments(const std::vector<glm::vec2>& slopes) {
  SlopeMoments s;
  const double share = 1.0 / static_cast<double>(slopes.size());
  for (const glm::vec2& slope : slopes) s.mean += share * glm::dvec2(slope);
  for (const glm::vec2& slope : slopes) {
    const glm::dvec2 d = glm::dvec2(slope) - s.mean;
    s.xx += share * d.x * d.x;
    s.xy += share * d.x * d.y;
    s.yy += share * d.y * d.y;
  }
  return s;
}

// The sum over the Gaussian of f(slope).
template <typename Function>
double overSlopes(const SlopeMoments& s, const Function& f) {
  const double root_xx = std::sqrt(s.xx), lean = s.xy / root_xx,
               rest = std::sqrt(std::max(0.0, s.yy - lean * lean));
  double sum = 0, weights = 0;
  for (int i = 0; i < kSlopeSteps; ++i)
    for (int j = 0; j < kSlopeSteps; ++j) {
      const double u = kSlopeReach * ((2 * i + 1.0) / kSlopeSteps - 1);
      const double v = kSlopeReach * ((2 * j + 1.0) / kSlopeSteps - 1);
      const double weight = std::exp(-0.5 * (u * u + v * v));
      sum += weight * f(s.mean + glm::dvec2(root_xx * u, lean * u + rest * v));
      weights += weight;
    }
  return sum / weights;
}

double facetShown(const glm::dvec3& d, const glm::dvec2& slope) {
  return d.z + d.x * slope.x + d.y * slope.y;
}

struct FacetArea {
  double facets = 0, plane = 0;
};
FacetArea facetArea(const SlopeMoments& s, const glm::dvec3& d) {
  return {
      overSlopes(s, [&](const glm::dvec2& slope) { return std::max(0.0, facetShown(d, slope)); }),
      overSlopes(s, [&](const glm::dvec2& slope) { return facetShown(d, slope); })};
}
double maskedFacets(const FacetArea& view, const FacetArea& light) {
  return view.facets + std::max(0.0, view.plane) * (light.facets / light.plane - 1);
}

// What of one direction of light is the same for all lights of a pixel, or all pixels of a light,
// is not worth telling apart here.
struct Facets {
  double specular = 0, cosine = 0;
};
Facets facetsOf(const SlopeMoments& own, const SlopeMoments& wide, const glm::dvec3& view,
                const glm::dvec3& light) {
  Facets facets;
  const FacetArea own_light = facetArea(own, light), wide_light = facetArea(wide, light);
  if (own_light.plane <= 0) return facets;
  facets.cosine = overSlopes(own,
                             [&](const glm::dvec2& slope) {
                               return std::max(0.0, facetShown(view, slope)) *
                                      std::max(0.0, facetShown(light, slope)) /
                                      std::sqrt(1 + glm::dot(slope, slope));
                             }) /
                  maskedFacets(facetArea(own, view), own_light);
  const glm::dvec3 h = glm::normalize(view + light);
  const glm::dvec2 off = glm::dvec2(h) / h.z - wide.mean;
  const double determinant = wide.xx * wide.yy - wide.xy * wide.xy;
  const double square =
      (off.x * off.x * wide.yy + off.y * off.y * wide.xx - 2 * off.x * off.y * wide.xy) /
      determinant;
  const double density =
      std::exp(-0.5 * square) / (2 * kPi * std::sqrt(determinant) * std::pow(h.z, 4));
  facets.specular = density / (4 * maskedFacets(facetArea(wide, view), wide_light));
  return facets;
}

// The highlight and the diffuse layer are asked for one by one: abscissas have the second alone.
struct LeadrCase {
  const char* name;
  std::vector<glm::vec2> slopes;
  bool specular;
};
const std::vector<glm::vec2> kLevelSlopes = {
    {0.4f, 0.1f}, {-0.4f, -0.1f}, {0.1f, 0.3f}, {-0.1f, -0.3f}};
const std::vector<glm::vec2> kTiltedSlopes = {
    {0.9f, 0.2f}, {0.1f, 0.4f}, {0.5f, -0.1f}, {0.3f, 0.1f}};
const std::vector<glm::vec2> kSteepSlopes = {
    {1.5f, 0.3f}, {-1.2f, 0.4f}, {0.2f, -1.1f}, {-0.4f, 0.9f}};
const std::vector<LeadrCase>& leadrCases() {
  static const std::vector<LeadrCase> cases = {{"leadr/level", kLevelSlopes, true},
                                               {"leadr/tilted", kTiltedSlopes, true},
                                               {"leadr/steep", kSteepSlopes, true},
                                               {"leadr/level_diffuse", kLevelSlopes, false},
                                               {"leadr/tilted_diffuse", kTiltedSlopes, false},
                                               {"leadr/steep_diffuse", kSteepSlopes, false}};
  return cases;
}

Finding facetsAreSeen(const CheckContext& context, const LeadrCase& c) {
  NormalMap map;
  map.name = "slopes";
  map.width_px = kFacetStrip_px;
  map.height_px = 1;
  for (std::size_t i = 0; i < kFacetStrip_px; ++i)
    map.normals.push_back(
        glm::normalize(glm::vec3(c.slopes[i * c.slopes.size() / kFacetStrip_px], 1)));
  Scene scene = mappedFloor(map);
  for (auto& uv : scene.mesh.uvs) uv *= static_cast<float>(kFacetMaps);
  SurfaceMaterial& surface = scene.materials[0].params.surface;
  surface.f0 = {0.04f, 0.5f, 0.9f, 0};
  surface.albedo = {0.3f, 0.2f, 0.1f, 0};
  if (c.specular) surface.albedo = {};
  if (!c.specular) surface.intensity = 0;
  const auto rgb = [](const float4& v) { return glm::dvec3(v.x, v.y, v.z); };
  const auto in_floor = [](const glm::dvec3& w) { return glm::dvec3(w.x, -w.z, w.y); };
  const reference::CoatedDiffuse coat(reference::Ndf::kBeckmann, surface.alpha_g.x, rgb(surface.f0),
                                      surface.intensity);
  const SlopeMoments own = slopeMoments(c.slopes);
  SlopeMoments wide = own;
  const double base = surface.alpha_g.x;
  wide.xx += 0.5 * base * base;
  wide.yy += 0.5 * base * base;
  const glm::dvec3 mean = glm::normalize(glm::dvec3(own.mean, 1));
  const auto textures = std::make_shared<NormalTextures>(context.bench.device);
  ShadingOptions options{
      .width_px = kFacetFrame_px, .height_px = kFacetFrame_px, .lanes = context.lanes};
  options.normal_method = NormalMethod::kLeadr;
  Finding finding(c.specular ? kLeadrHighlight : kLeadrDiffuse);
  for (const double angle_deg : {80.0, 35.0, 15.0}) {
    FrameRenderer renderer(context.bench.device, scene, lookingDown(angle_deg, 3), options, 1,
                           textures);
    renderer.prepare();
    renderer.shade();
    const Image image = renderer.readRadiance();
    for (int y = 0; y < kFacetFrame_px; y += 7)
      for (int x = 0; x < kFacetFrame_px; x += 7) {
        const glm::dvec3 view = in_floor(-glm::normalize(renderer.camera().ray(x, y)));
        const glm::dvec3 share = coat.share(std::max(0.0, glm::dot(mean, view)));
        glm::dvec3 want(0);
        for (const ConeLight& light : scene.lights) {
          const glm::dvec3 i = in_floor(glm::normalize(rgb(light.direction)));
          const Facets facets = facetsOf(own, wide, view, i);
          const glm::dvec3 fresnel =
              reference::schlick(rgb(surface.f0), glm::dot(i, glm::normalize(i + view)));
          want += rgb(light.irradiance) *
                  (static_cast<double>(surface.intensity) * facets.specular * fresnel +
                   rgb(surface.albedo) * share * facets.cosine / kPi);
        }
        for (std::size_t k = 0; k < 3; ++k)
          finding.add(std::abs(image.at(x, y)[k] / want[static_cast<int>(k)] - 1));
      }
  }
  return finding;
}

}  // namespace

std::vector<Check> leadrChecks() {
  std::vector<Check> checks;
  for (const LeadrCase& c : leadrCases())
    checks.push_back({c.name, "error of what facets show",
                      [&c](const CheckContext& context) { return facetsAreSeen(context, c); }});
  return checks;
}

}  // namespace glintmark
