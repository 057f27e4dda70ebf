#include "host/harness/area_light_harness.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/filter/mip_texels.h"
#include "host/frame/effect/area_lights.h"

namespace glintmark {
namespace {

constexpr const char* kProbes = "probes/probe_area_light.cl";

// Fourteen planes of numbers.
std::vector<float> pointPlanes(const std::vector<HandMadePoint>& points, std::size_t stride) {
  std::vector<float> planes(14 * stride);
  for (std::size_t i = 0; i < stride; ++i) {
    const HandMadePoint& p = points[std::min(i, points.size() - 1)];
    for (int c = 0; c < 3; ++c) {
      const auto plane = static_cast<std::size_t>(c);
      planes[plane * stride + i] = static_cast<float>(p.position[c]);
      planes[(3 + plane) * stride + i] = static_cast<float>(p.normal[c]);
      planes[(6 + plane) * stride + i] = static_cast<float>(p.view[c]);
    }
    planes[9 * stride + i] = static_cast<float>(p.alpha);
    planes[10 * stride + i] = static_cast<float>(p.alpha_across);
    for (int c = 0; c < 3; ++c)
      planes[(11 + static_cast<std::size_t>(c)) * stride + i] = static_cast<float>(p.axis[c]);
  }
  return planes;
}

// The table of round lobes and, behind it, that of others, as frames hand them to the kernels.
std::vector<float> tableValues(const AreaLightProbe& probe) {
  std::vector<float> values = probe.table.values;
  if (probe.anisotropic != nullptr) {
    const std::vector<float> stretched = probe.anisotropic->paddedValues();
    values.insert(values.end(), stretched.begin(), stretched.end());
  }
  return values;
}

// The pictures of lights, one after the other, as the kernels read them.
struct Pictures {
  std::vector<MipTexture> layouts;
  std::vector<float4> texels;
};

Pictures picturesOf(const std::vector<AreaLight>& lights) {
  Pictures pictures;
  for (const AreaLight& light : lights) {
    if (light.texture.pixels.empty()) continue;
    const MipTexels packed = packMipChain(prefilterLightTexture(light.texture), 1);
    MipTexture layout = packed.layout;
    for (auto& first : layout.first) first += static_cast<uint>(pictures.texels.size());
    pictures.layouts.push_back(layout);
    pictures.texels.insert(pictures.texels.end(), packed.texels.begin(), packed.texels.end());
  }
  return pictures;
}

}  // namespace

std::vector<glm::vec3> lightPoints(KernelBench& bench, const AreaLightProbe& probe,
                                   const std::vector<HandMadePoint>& points) {
  const std::size_t stride = paddedCount(points.size());
  std::size_t vertices = 3;
  bool shapes = false;
  for (const AreaLight& light : probe.lights) {
    vertices = std::max(vertices, light.vertices.size());
    shapes = shapes || light.shape != LightShape::kPolygon;
  }
  const bool diffuse = probe.material.surface.albedo.x > 0;
  Buffer out(bench.device, 3 * stride * 4, BufferPurpose::kProbe);
  const Pictures pictures = picturesOf(probe.lights);
  const bool textured = !pictures.layouts.empty();
  std::vector<KernelArg> args;
  args.reserve(10);
  args.emplace_back(probeData(bench, pointPlanes(points, stride)));
  args.emplace_back(probeData(bench, std::vector{probe.material}));
  args.emplace_back(probeData(bench, prepareAreaLights(probe.lights, glm::dvec3(0))));
  args.emplace_back(probeData(bench, tableValues(probe)));
  if (textured) {
    args.emplace_back(probeData(bench, pictures.layouts));
    args.emplace_back(probeData(bench, pictures.texels));
  }
  args.emplace_back(out);
  args.emplace_back(static_cast<std::uint32_t>(probe.lights.size()));
  args.emplace_back(static_cast<std::uint32_t>(probe.table.size));
  args.emplace_back(static_cast<std::uint32_t>(stride));
  probeKernel(bench, kProbes, "probeAreaLights",
              fmt::format("-D WIDTH={} -D LTC=1 -D LIGHT_VERTICES={} -D DIFFUSE={:d} "
                          "-D CLIPLESS={:d} -D LIGHT_TEXTURE={:d} -D ALBEDO_SCALING={:d} "
                          "-D LIGHT_SHAPES={:d} -D LTC_ANISOTROPIC={:d}",
                          probe.width, vertices, diffuse, probe.clipless, textured,
                          diffuse && probe.material.surface.intensity > 0, shapes,
                          probe.anisotropic != nullptr))
      .launch(args, stride / static_cast<std::size_t>(probe.width), kLocalSize);
  std::vector<float> values(3 * stride);
  out.read(values.data(), values.size() * 4);
  std::vector<glm::vec3> result;
  for (std::size_t i = 0; i < points.size(); ++i)
    result.emplace_back(values[i], values[stride + i], values[2 * stride + i]);
  return result;
}

std::vector<float> footprintAlphas(KernelBench& bench, LtcMethod method, float micro,
                                   const std::vector<float>& lengths, int width) {
  std::vector<float> padded = lengths;
  padded.resize(paddedCount(lengths.size()), lengths.back());
  Buffer out(bench.device, padded.size() * 4, BufferPurpose::kProbe);
  const std::vector<KernelArg> args = {probeData(bench, padded), out,
                                       static_cast<std::uint32_t>(padded.size()), micro};
  probeKernel(bench, kProbes, "probeFootprintAlpha",
              fmt::format("-D WIDTH={} -D LTC=1 -D LTC_METHOD={}", width, static_cast<int>(method)))
      .launch(args, padded.size() / static_cast<std::size_t>(width), kLocalSize);
  out.read(padded.data(), padded.size() * 4);
  padded.resize(lengths.size());
  return padded;
}

LtcTable identityTable() {
  LtcTable table(reference::Ndf::kGgx, LTC_SIZE_MIN);
  for (int y = 0; y < table.size; ++y)
    for (int x = 0; x < table.size; ++x) table.setCell(x, y, LtcCell{});
  return table;
}

MaterialParams whiteSpecular() {
  MaterialParams material{};
  material.surface.alpha_g = material.glints.alpha_l = {1, 1};
  material.surface.intensity = 1;
  material.surface.f0 = {1, 1, 1, 0};
  return material;
}

MaterialParams whiteDiffuse() {
  MaterialParams material = whiteSpecular();
  material.surface.intensity = 0;
  material.surface.albedo = {1, 1, 1, 0};
  return material;
}

AreaLight polygonLight(std::vector<glm::dvec3> vertices, bool two_sided) {
  AreaLight light;
  light.vertices = std::move(vertices);
  light.two_sided = two_sided;
  return light;
}

}  // namespace glintmark
