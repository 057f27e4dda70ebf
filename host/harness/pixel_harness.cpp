#include "host/harness/pixel_harness.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "host/core/error.h"
#include "host/core/float4.h"
#include "host/core/glint_grids.h"
#include "host/core/planes.h"
#include "host/frame/effect/glint_table.h"
#include "host/frame/effect/light_taps.h"
#include "host/frame/effect/light_tree.h"
#include "host/frame/effect/lights.h"
#include "host/frame/effects.h"
#include "host/frame/shade_arguments.h"
#include "host/frame/specular_albedo.h"

namespace glintmark {
namespace {

constexpr std::uint32_t kLimitedBit = 0x80000000u;

std::uint32_t bitsOf(double value) {
  return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

std::vector<std::uint32_t> planeWords(const HandMadeFrame& frame, PlaneMask mask,
                                      std::size_t stride) {
  std::vector<std::uint32_t> words(mask.size() * stride);
  for (std::size_t i = 0; i < stride; ++i) {
    const HandMadePixel& pixel = frame.pixels[std::min(i, frame.pixels.size() - 1)];
    const reference::PixelFootprint& f = pixel.footprint;
    const auto store = [&](Plane plane, std::uint32_t word) {
      if (mask.has(plane)) words[mask.slot(plane) * stride + i] = word;
    };
    store(Plane::kPixel, pixel.y << 16 | pixel.x);
    store(Plane::kUInt, static_cast<std::uint32_t>(f.u.integer));
    store(Plane::kVInt, static_cast<std::uint32_t>(f.v.integer));
    store(Plane::kUFrac, f.u.fraction);
    store(Plane::kVFrac, f.v.fraction);
    store(Plane::kDudx, bitsOf(f.duv_dx.x));
    store(Plane::kDvdx, bitsOf(f.duv_dx.y));
    store(Plane::kDudy, bitsOf(f.duv_dy.x));
    store(Plane::kDvdy, bitsOf(f.duv_dy.y));
    store(Plane::kFrame0, pixel.frame.frame0);
    store(Plane::kFrame1, pixel.frame.frame1);
    store(Plane::kDnxDx, bitsOf(pixel.normal_dx.x));
    store(Plane::kDnyDx, bitsOf(pixel.normal_dx.y));
    store(Plane::kDnzDx, bitsOf(pixel.normal_dx.z));
    store(Plane::kDnxDy, bitsOf(pixel.normal_dy.x));
    store(Plane::kDnyDy, bitsOf(pixel.normal_dy.y));
    store(Plane::kDnzDy, bitsOf(pixel.normal_dy.z));
  }
  return words;
}

FrameParams paramsOf(const HandMadeFrame& frame, std::size_t stride) {
  FrameParams params{};
  params.ray_origin = toFloat4(frame.ray_origin);
  params.ray_dx = toFloat4(frame.ray_dx);
  params.ray_dy = toFloat4(frame.ray_dy);
  params.list_count = static_cast<uint>(frame.pixels.size());
  params.plane_stride = static_cast<uint>(stride);
  return params;
}

glm::dvec3 toDouble(const float4& v) {
  return {v.x, v.y, v.z};
}

MaterialParams materialOf(const HandMadeFrame& frame, const KernelConfig& config) {
  MaterialParams material = withGlintGrids(frame.material);
  if (config.albedo_scaling) setSpecularAlbedo(material.surface, config.ggx);
  return material;
}

}  // namespace

ShadedPixels shadePixels(KernelBench& bench, const HandMadeFrame& frame, KernelConfig config) {
  ShadedPixels result;
  if (frame.pixels.empty()) return result;
  Device& device = bench.device;
  config.planes = planesFor(config);
  const std::size_t n = frame.pixels.size();
  const std::size_t stride = (n + GM_LIST_PADDING - 1) / GM_LIST_PADDING * GM_LIST_PADDING;

  Buffer radiance(device, stride * 12, BufferPurpose::kProbe, "radiance");
  Buffer counts(device, stride * 8, BufferPurpose::kProbe, "counts");
  const bool cuts = config.light_cut != LightCut::kAll;
  const std::vector<LightParams> lights =
      cuts ? prepareLightTree(frame.lights) : prepareLights(frame.lights);
  FrameParams params = paramsOf(frame, stride);
  params.light_count = static_cast<uint>(lights.size());
  ShadeArguments arguments({.planes = probeData(bench, planeWords(frame, config.planes, stride)),
                            .frame = probeData(bench, std::vector{params}),
                            .material = probeData(bench, std::vector{materialOf(frame, config)}),
                            .lights = probeData(bench, lights)});
  if (const auto table = glintTable(device, config, BufferPurpose::kProbe))
    arguments.add("glint_table", *table);
  if (frame.scatter) arguments.add("scatter", probeData(bench, std::vector{*frame.scatter}));
  if (config.multiscatter != Multiscatter::kOff ||
      config.metal_compensation > MetalCompensation::kScaled) {
    const PreparedTaps taps = prepareTaps(cuts ? lightTree(frame.lights).lights : frame.lights);
    arguments.add("light_taps", probeData(bench, taps.lights));
    arguments.add("taps", probeData(bench, taps.directions));
  }
  arguments.add("radiance", radiance);
  if (config.count_cells) arguments.add("cell_counts", counts);
  const auto lanes = static_cast<std::size_t>(config.width);
  Kernel kernel = bench.cache.get("shade.cl", config).kernel("shade");
  launchShading(kernel, arguments, (n + lanes - 1) / lanes, kLocalSize);

  std::vector<float> words(stride * 3);
  radiance.read(words.data(), words.size() * 4);
  for (std::size_t i = 0; i < n; ++i)
    result.radiance.emplace_back(words[i], words[stride + i], words[2 * stride + i]);
  if (config.count_cells) {
    result.cells.resize(2 * stride);
    counts.read(result.cells.data(), stride * 8);
    const auto paid = result.cells.begin() + static_cast<std::ptrdiff_t>(stride);
    result.paid.assign(paid, paid + static_cast<std::ptrdiff_t>(n));
    result.cells.resize(n);
    for (std::uint32_t& cells : result.cells) {
      result.limited.push_back((cells & kLimitedBit) != 0);
      cells &= ~kLimitedBit;
    }
  }
  return result;
}

MaterialParams simpleMaterial(float2 alpha_g, float2 alpha_l, float density, float size_variation) {
  MaterialParams material{};
  material.surface.alpha_g = alpha_g;
  material.glints.alpha_l = alpha_l;
  material.glints.density = density;
  material.glints.size_variation = size_variation;
  material.surface.intensity = 1;
  material.surface.f0 = {1, 1, 1, 0};
  return material;
}

ConeLight coneLight(const glm::dvec3& direction, double half_angle_rad, double irradiance) {
  ConeLight light{};
  light.direction = toFloat4(glm::normalize(direction));
  light.direction.w = static_cast<float>(half_angle_rad);
  const auto e = static_cast<float>(irradiance);
  light.irradiance = {e, e, e, 0};
  return light;
}

reference::FixedCoordinate fixedCoordinate(double coordinate) {
  const double whole = std::floor(coordinate);
  return {static_cast<std::int32_t>(whole),
          static_cast<std::uint32_t>((coordinate - whole) * 0x1p32)};
}

PackedFrame flatFrame() {
  return packFrame({0, 0, 1}, {1, 0, 0}, false);
}

reference::GlintRule referenceRule(GlintMethod method) {
  switch (method) {
    case GlintMethod::kExact:
      return reference::GlintRule::kExact;
    case GlintMethod::kDistributed:
      return reference::GlintRule::kDistributed;
    case GlintMethod::kDeliotBelcour:
      return reference::GlintRule::kDeliotBelcour;
    case GlintMethod::kDeliotCorrected:
      return reference::GlintRule::kDeliotCorrected;
    case GlintMethod::kKemppinen:
      return reference::GlintRule::kKemppinen;
    case GlintMethod::kPublishedZk16:
      return reference::GlintRule::kPublishedZk16;
    case GlintMethod::kChermain:
      return reference::GlintRule::kChermain;
    case GlintMethod::kChermainCorrected:
      return reference::GlintRule::kChermainCorrected;
    default:
      return reference::GlintRule::kZk16;
  }
}

reference::Glints referenceGlints(const MaterialParams& material, bool groove) {
  reference::Glints glints;
  glints.alpha_g = {material.surface.alpha_g.x, material.surface.alpha_g.y};
  glints.alpha_l = {material.glints.alpha_l.x, material.glints.alpha_l.y};
  glints.density = material.glints.density;
  glints.size_variation = material.glints.size_variation;
  glints.intensity = material.surface.intensity;
  glints.f0 = toDouble(material.surface.f0);
  glints.groove = groove;
  return glints;
}

reference::SurfacePixel referencePixel(const HandMadeFrame& frame, const HandMadePixel& pixel) {
  reference::SurfacePixel surface;
  surface.footprint = pixel.footprint;
  // The planes hold floats.
  for (glm::dvec2* d : {&surface.footprint.duv_dx, &surface.footprint.duv_dy})
    *d = glm::dvec2(glm::vec2(*d));
  surface.frame = unpackFrame(pixel.frame);
  const glm::dvec3 ray = glm::dvec3(glm::vec3(frame.ray_origin)) +
                         glm::dvec3(glm::vec3(frame.ray_dx)) * static_cast<double>(pixel.x) +
                         glm::dvec3(glm::vec3(frame.ray_dy)) * static_cast<double>(pixel.y);
  surface.view = -glm::normalize(ray);
  return surface;
}

std::vector<reference::PointLight> referenceLights(const HandMadeFrame& frame) {
  std::vector<reference::PointLight> lights;
  for (const ConeLight& light : frame.lights)
    lights.push_back({glm::normalize(toDouble(light.direction)), toDouble(light.irradiance)});
  return lights;
}

}  // namespace glintmark
