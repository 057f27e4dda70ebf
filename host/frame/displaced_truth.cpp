#include "host/frame/displaced_truth.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <optional>
#include <tuple>
#include <vector>

#include "host/core/angles.h"
#include "host/core/error.h"
#include "host/raster/camera.h"
#include "host/reference/beckmann.h"
#include "host/reference/microfacet.h"

namespace glintmark {
namespace {

constexpr int kMostReliefSpp = 1 << 20;
// Steps along a ray, in texels; a crossing within one is found by halving it.
constexpr double kMarch_px = 0.25;
constexpr int kHalvings = 24;
// A shadow ray starts so far above its surface, in texels.
constexpr double kLift_px = 1e-3;
// A ray that stays among the heights is given up after so many maps.
constexpr double kMostMaps = 4;
// As in kernels/truth.cl: cosine of a view that meets a normal at its horizon.
constexpr double kLeastViewZ = 1e-4;
constexpr double kFlatTolerance = 1e-5;

// Points of space as (u, v, height), all in units of uv.
struct ReliefRay {
  glm::dvec3 origin, direction;
  glm::dvec3 at(double t) const { return origin + t * direction; }
};

// The relief over the whole plane.
class Relief {
 public:
  Relief(const NormalMap& map, double scale) : map_(map), scale_(scale) {
    const auto [low, high] = std::minmax_element(map.heights.begin(), map.heights.end());
    low_ = std::min(*low * scale, *high * scale);
    high_ = std::max(*low * scale, *high * scale);
  }

  glm::dvec3 normal(const glm::dvec3& place) const {
    return glm::normalize(
        between<glm::dvec3>(place, [&](std::size_t i) { return glm::dvec3(map_.normals[i]); }));
  }
  double texel() const { return 1.0 / std::max(map_.width_px, map_.height_px); }

  /// Where the ray first goes under the relief.
  std::optional<double> firstHit(const ReliefRay& ray) const {
    const double fall = ray.direction.z;
    if (high_ - low_ < 1e-12) {
      const double t = fall < 0 ? (high_ - ray.origin.z) / fall : -1;
      return t > 0 ? std::optional(t) : std::nullopt;
    }
    const double across = std::hypot(ray.direction.x, ray.direction.y);
    double begin = 0, end = kMostMaps / std::max(across, 1e-9);
    if (fall < 0) {
      begin = std::max(0.0, (high_ - ray.origin.z) / fall);
      end = std::min(end + begin, (low_ - 1e-9 - ray.origin.z) / fall);
    } else if (fall > 0) {
      end = std::min(end, (high_ - ray.origin.z) / fall);
    }
    if (ray.at(begin).z > high_ + 1e-9 || end <= begin) return std::nullopt;
    const double step = std::min(kMarch_px * texel() / std::max(across, 1e-9), (end - begin) / 4);
    double before = begin;
    for (double t = begin; t < end;) {
      t = std::min(t + step, end);
      if (above(ray, t) <= 0) return crossing(ray, before, t);
      before = t;
    }
    return std::nullopt;
  }

 private:
  // The value of four texels, repeated, at a place.
  template <typename T, typename Value>
  T between(const glm::dvec3& place, const Value& value) const {
    const auto axis = [](double x, int size) {
      const double whole = std::floor(x), rest = x - whole;
      const int first = static_cast<int>(std::fmod(std::fmod(whole, size) + size, size));
      return std::tuple(first, (first + 1) % size, rest);
    };
    const auto [x0, x1, fx] = axis(place.x * map_.width_px - 0.5, map_.width_px);
    const auto [y0, y1, fy] = axis(place.y * map_.height_px - 0.5, map_.height_px);
    const auto at = [&](int x, int y) {
      return value(static_cast<std::size_t>(y) * static_cast<std::size_t>(map_.width_px) +
                   static_cast<std::size_t>(x));
    };
    return (1 - fy) * ((1 - fx) * at(x0, y0) + fx * at(x1, y0)) +
           fy * ((1 - fx) * at(x0, y1) + fx * at(x1, y1));
  }

  double above(const ReliefRay& ray, double t) const {
    const glm::dvec3 place = ray.at(t);
    return place.z - scale_ * between<double>(place, [&](std::size_t i) {
                       return static_cast<double>(map_.heights[i]);
                     });
  }

  double crossing(const ReliefRay& ray, double over, double under) const {
    for (int i = 0; i < kHalvings; ++i) {
      const double middle = 0.5 * (over + under);
      (above(ray, middle) > 0 ? over : under) = middle;
    }
    return 0.5 * (over + under);
  }

  const NormalMap& map_;
  double scale_, low_ = 0, high_ = 0;
};

// The mesh's plane: tangent axes along u and v, and where its uv lie.
struct ReliefPlane {
  glm::dvec3 origin{}, along_u{}, along_v{}, normal{};  // of (u, v) = first_uv; axes unit
  glm::dvec2 first_uv{}, least_uv{}, most_uv{};
  double length = 1;  // scene units of a unit of uv

  glm::dvec3 toRelief(const glm::dvec3& direction) const {
    return glm::dvec3(glm::dot(direction, along_u), glm::dot(direction, along_v),
                      glm::dot(direction, normal)) /
           length;
  }
  ReliefRay toRelief(const glm::dvec3& eye, const glm::dvec3& direction) const {
    return {toRelief(eye - origin) + glm::dvec3(first_uv, 0), toRelief(direction)};
  }
  bool holds(const glm::dvec3& place) const {
    return place.x >= least_uv.x && place.y >= least_uv.y && place.x <= most_uv.x &&
           place.y <= most_uv.y;
  }
};

[[noreturn]] void refuse(const Scene& scene, const char* why) {
  throw Error(fmt::format("scene {} has no displaced truth: {}", scene.name, why));
}

ReliefPlane planeOf(const Scene& scene) {
  const TriangleMesh& mesh = scene.mesh;
  if (mesh.triangles.empty()) refuse(scene, "its mesh is empty");
  const glm::uvec3 t = mesh.triangles[0];
  const glm::dvec3 p0(mesh.positions[t.x]), e1 = glm::dvec3(mesh.positions[t.y]) - p0,
                                            e2 = glm::dvec3(mesh.positions[t.z]) - p0;
  const glm::dvec2 f1 = mesh.uvs[t.y] - mesh.uvs[t.x], f2 = mesh.uvs[t.z] - mesh.uvs[t.x];
  const double area = f1.x * f2.y - f1.y * f2.x;
  if (area == 0) refuse(scene, "its first triangle has no area in uv");
  const glm::dvec3 du = (f2.y * e1 - f1.y * e2) / area, dv = (f1.x * e2 - f2.x * e1) / area;
  ReliefPlane plane;
  plane.length = glm::length(du);
  plane.origin = p0;
  plane.first_uv = plane.least_uv = plane.most_uv = mesh.uvs[t.x];
  plane.along_u = du / plane.length;
  plane.along_v = dv / plane.length;
  plane.normal = glm::dvec3(mesh.normals[t.x]);
  if (std::abs(glm::length(dv) / plane.length - 1) > kFlatTolerance ||
      std::abs(glm::dot(plane.along_u, plane.along_v)) > kFlatTolerance)
    refuse(scene, "u and v do not stand square and alike on its mesh");
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const glm::dvec3 place = plane.toRelief(glm::dvec3(mesh.positions[i]) - p0);
    const glm::dvec2 off = mesh.uvs[i] - plane.first_uv - glm::dvec2(place);
    if (std::abs(place.z) > kFlatTolerance || glm::length(off) > kFlatTolerance)
      refuse(scene, "its mesh is not one flat rectangle");
    plane.least_uv = glm::min(plane.least_uv, mesh.uvs[i]);
    plane.most_uv = glm::max(plane.most_uv, mesh.uvs[i]);
  }
  return plane;
}

const Material& materialOf(const Scene& scene) {
  if (scene.materials.size() != 1) refuse(scene, "it has several materials");
  const Material& material = scene.materials[0];
  if (!material.normal_map || material.normal_map->map->heights.empty())
    refuse(scene, "its material has no normal map that was made of heights");
  if (material.has_glints || material.diffuse_model != DiffuseModel::kLambert ||
      material.compensation != Compensation::kOff)
    refuse(scene, "its material is not a smooth lobe over a Lambertian layer");
  if (!scene.area_lights.empty()) refuse(scene, "it has area lights");
  for (const ConeLight& light : scene.lights)
    if (light.direction.w > 0) refuse(scene, "one of its lights is wider than a point");
  return material;
}

glm::dvec3 reliefRgb(const float4& v) {
  return {v.x, v.y, v.z};
}

class DisplacedTruth {
 public:
  DisplacedTruth(const Scene& scene, const View& view, const DisplacedTruthOptions& options)
      : scene_(scene),
        surface_(materialOf(scene).params.surface),
        plane_(planeOf(scene)),
        relief_(*scene.materials[0].normal_map->map, options.height_scale),
        coat_(reference::Ndf::kBeckmann, surface_.alpha_g.x, reliefRgb(surface_.f0),
              surface_.intensity),
        camera_(makeCamera(view, options.width_px, options.height_px)),
        spp_(options.spp) {
    if (glm::dot(camera_.eye - plane_.origin, plane_.normal) <= 0)
      refuse(scene, "the eye is behind its mesh");
    for (const ConeLight& light : scene.lights)
      lights_.push_back(
          glm::normalize(plane_.toRelief(glm::normalize(reliefRgb(light.direction)))));
  }

  glm::dvec4 pixel(int x, int y) const {
    const ReliefRay centre = plane_.toRelief(camera_.eye, camera_.ray(x, y));
    const double meets = centre.direction.z < 0 ? -centre.origin.z / centre.direction.z : -1;
    if (meets <= 0 || !plane_.holds(centre.at(meets))) return glm::dvec4(0);
    glm::dvec3 sum(0);
    int hits = 0;
    // The R2 sequence of kernels/truth.cl, from another start in each pixel.
    std::uint32_t seed = static_cast<std::uint32_t>(y * camera_.width_px + x) * 0x9E3779B9u;
    seed = (seed ^ (seed >> 15)) * 0x2C1B3C6Du;
    seed ^= seed >> 12;
    for (int i = 0; i < spp_; ++i) {
      const double sx = (seed + static_cast<std::uint32_t>(i) * 0xC13FA9A9u) * 0x1p-32 - 0.5;
      const double sy =
          (seed * 0x85EBCA6Bu + static_cast<std::uint32_t>(i) * 0x91E10DA5u) * 0x1p-32 - 0.5;
      const ReliefRay ray = plane_.toRelief(camera_.eye, camera_.ray(x + sx, y + sy));
      const std::optional<double> t = relief_.firstHit(ray);
      if (!t || !plane_.holds(ray.at(*t))) continue;
      sum += shade(ray.at(*t), -glm::normalize(ray.direction));
      ++hits;
    }
    return {sum / static_cast<double>(std::max(hits, 1)), 1};
  }

 private:
  glm::dvec3 shade(const glm::dvec3& place, const glm::dvec3& view) const {
    const glm::dvec3 n = relief_.normal(place);
    const glm::dvec3 side = std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 t = glm::normalize(glm::cross(side, n)), b = glm::cross(n, t);
    const auto local = [&](const glm::dvec3& w) {
      return glm::dvec3(glm::dot(t, w), glm::dot(b, w), glm::dot(n, w));
    };
    const glm::dvec3 o = local(view);
    const glm::dvec3 share = coat_.share(std::max(o.z, kLeastViewZ));
    const glm::dvec3 lifted = place + glm::dvec3(0, 0, kLift_px * relief_.texel());
    glm::dvec3 sum(0);
    for (std::size_t k = 0; k < lights_.size(); ++k) {
      const glm::dvec3 i = local(lights_[k]);
      if (i.z <= 0 || relief_.firstHit({lifted, lights_[k]})) continue;
      const glm::dvec3 specular = reference::brdfTimesCosine(
          i, o, glm::dvec2(surface_.alpha_g.x, surface_.alpha_g.y), reliefRgb(surface_.f0));
      sum += reliefRgb(scene_.lights[k].irradiance) *
             (static_cast<double>(surface_.intensity) * specular +
              reliefRgb(surface_.albedo) * share * i.z / kPi);
    }
    return sum;
  }

  const Scene& scene_;
  const SurfaceMaterial& surface_;
  ReliefPlane plane_;
  Relief relief_;
  reference::CoatedDiffuse coat_;
  Camera camera_;
  int spp_;
  std::vector<glm::dvec3> lights_;
};

}  // namespace

Image renderDisplacedTruth(const Scene& scene, const View& view,
                           const DisplacedTruthOptions& options,
                           const std::function<void(int rows)>& progress) {
  if (options.spp < 1 || options.spp > kMostReliefSpp)
    throw Error(fmt::format("a truth of {} samples a pixel cannot be made; it has 1 to {}",
                            options.spp, kMostReliefSpp));
  const DisplacedTruth truth(scene, view, options);
  Image image(options.width_px, options.height_px, 4);
  image.channel_names = {"R", "G", "B", "A"};
  std::mutex telling;
  int rows = 0;
  tbb::parallel_for(0, options.height_px, [&](int y) {
    for (int x = 0; x < options.width_px; ++x) {
      const glm::dvec4 value = truth.pixel(x, y);
      for (int c = 0; c < 4; ++c)
        image.at(x, y)[static_cast<std::size_t>(c)] = static_cast<float>(value[c]);
    }
    const std::lock_guard lock(telling);
    ++rows;
    if (progress) progress(rows);
  });
  return image;
}

}  // namespace glintmark
