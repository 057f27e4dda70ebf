#include "host/frame/white_furnace.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <memory>
#include <span>

#include "host/core/angles.h"
#include "host/frame/frame_renderer.h"
#include "host/reference/microfacet.h"

namespace glintmark {
namespace {

constexpr int kSlopes = 128, kAzimuths = 32;  // azimuths over a whole turn
constexpr int kLights = kSlopes * kAzimuths;
constexpr std::size_t kLightsPerFrame = 1024;  // whose description fits constant memory of 64 KiB
constexpr int kSide_px = 2;
constexpr float kRepeats = 1e5f;  // of a normal map per unit: many under each pixel

struct PartOfSky {
  glm::dvec3 direction;  // tangent frame, z the normal
  double solid_angle;
};

// Directions of equal solid angles on a spiral that turns by the golden angle.
std::vector<PartOfSky> evenSky() {
  std::vector<PartOfSky> parts;
  for (int k = 0; k < kLights; ++k) {
    const double z = (k + 0.5) / kLights, sine = std::sqrt(1 - z * z);
    const double phi = kPi * (3 - std::sqrt(5.0)) * k;
    parts.push_back({{sine * std::cos(phi), sine * std::sin(phi), z}, 2 * kPi / kLights});
  }
  return parts;
}

// Mirror images of the view at normals over the quantiles of their distribution; the rule of
// reference::microfacetAlbedo().
std::vector<PartOfSky> mirroredSky(const glm::dvec3& view, double alpha, reference::Ndf ndf) {
  std::vector<PartOfSky> parts;
  for (int k = 0; k < kSlopes; ++k) {
    const double u = (k + 0.5) / kSlopes;
    const double slope =
        alpha * std::sqrt(ndf == reference::Ndf::kGgx ? u / (1 - u) : -std::log1p(-u));
    for (int j = 0; j < kAzimuths; ++j) {
      const double phi = (j + 0.5) * 2 * kPi / kAzimuths;
      const glm::dvec3 m =
          glm::normalize(glm::dvec3(slope * std::cos(phi), slope * std::sin(phi), 1));
      const double cosine = glm::dot(view, m);
      const glm::dvec3 direction = 2 * cosine * m - view;
      if (cosine <= 0 || direction.z <= 0) continue;
      const double density = reference::microfacetDensity(ndf, m, alpha);
      parts.push_back({direction, 4 * cosine / (density * m.z * kLights)});
    }
  }
  return parts;
}

// A square in the plane y = 0; its normal is y.
TriangleMesh squareMesh() {
  TriangleMesh mesh;
  for (const glm::vec2& corner :
       {glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1)}) {
    mesh.positions.emplace_back(100 * corner.x, 0, 100 * corner.y);
    mesh.normals.emplace_back(0, 1, 0);
    mesh.tangents.emplace_back(1, 0, 0, 1);
    mesh.uvs.emplace_back(corner.x, -corner.y);
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.triangle_materials = {0, 0};
  return mesh;
}

Scene squareScene(const Material& material, double view_cosine) {
  Scene scene;
  scene.name = "white_furnace";
  scene.mesh = squareMesh();
  if (material.normal_map)
    for (auto& uv : scene.mesh.uvs) uv *= kRepeats;
  scene.materials = {material};
  View view;
  view.fov_y_deg = 0.01;
  view.near_plane = 1e-3;
  scene.views = {orbitView(view, {.angle_deg = std::asin(view_cosine) * 180 / kPi})};
  return scene;
}

// A square under light of radiance 1. One renderer serves every part of every sky: it takes lights
// and material anew from its scene each time that it prepares, and keeps its programs. What it
// keeps beside them are the taps that rough diffuse lobes take of lights; those have a new renderer
// each.
class Furnace {
 public:
  Furnace(Device& device, const Material& material, double view_cosine, int lanes)
      : device_(device), scene_(squareScene(material, view_cosine)), lanes_(lanes) {}
  Furnace(const Furnace&) = delete;
  Furnace& operator=(const Furnace&) = delete;

  const View& view() const { return scene_.views[0]; }
  void setAlbedo(const float4& albedo) { scene_.materials[0].params.surface.albedo = albedo; }

  // Radiance of the square under `sky`.
  double radianceUnder(const std::vector<PartOfSky>& sky) {
    double sum = 0;
    for (std::size_t first = 0; first < sky.size(); first += kLightsPerFrame)
      sum += radianceUnder(
          std::span(sky).subspan(first, std::min(kLightsPerFrame, sky.size() - first)));
    return sum;
  }

 private:
  double radianceUnder(std::span<const PartOfSky> parts) {
    scene_.lights.clear();
    for (const PartOfSky& part : parts) {
      const glm::vec3 direction(part.direction);
      const auto power = static_cast<float>(part.solid_angle);
      scene_.lights.push_back(
          {{direction.y, direction.z, direction.x, 0}, {power, power, power, 0}});
    }
    if (!renderer_ || scene_.materials[0].diffuse_model != DiffuseModel::kLambert)
      renderer_ = std::make_unique<FrameRenderer>(
          device_, scene_, scene_.views[0],
          ShadingOptions{.width_px = kSide_px, .height_px = kSide_px, .lanes = lanes_});
    renderer_->prepare();
    renderer_->shade();
    const Image radiance = renderer_->readRadiance();
    double sum = 0;
    for (int y = 0; y < kSide_px; ++y)
      for (int x = 0; x < kSide_px; ++x) sum += radiance.at(x, y)[0] / (kSide_px * kSide_px);
    return sum;
  }

  Device& device_;
  Scene scene_;
  const int lanes_;
  std::unique_ptr<FrameRenderer> renderer_;
};

}  // namespace

double whiteFurnace(Device& device, const Material& material, double view_cosine, int lanes) {
  Furnace furnace(device, material, view_cosine, lanes);
  const SurfaceMaterial& surface = material.params.surface;
  if (surface.intensity == 0 || material.normal_map) return furnace.radianceUnder(evenSky());
  const glm::dvec3 towards = glm::normalize(furnace.view().eye - furnace.view().target);
  const glm::dvec3 local(towards.z, towards.x, towards.y);  // x' = z, y' = x, z' = y
  // What the diffuse layer adds, whatever the even directions make of the lobe.
  const double with_diffuse = surface.albedo.x == 0 ? 0 : furnace.radianceUnder(evenSky());
  furnace.setAlbedo({});
  const double specular = furnace.radianceUnder(mirroredSky(
      local, surface.alpha_g.x, material.ggx ? reference::Ndf::kGgx : reference::Ndf::kBeckmann));
  if (surface.albedo.x == 0) return specular;
  return specular + with_diffuse - furnace.radianceUnder(evenSky());
}

}  // namespace glintmark
