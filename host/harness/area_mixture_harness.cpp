#include "host/harness/area_mixture_harness.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/frame/effect/area_lights.h"
#include "host/harness/specular_cases.h"

namespace glintmark {
namespace {

// Six planes of positions and views, then four of each lobe.
std::vector<float> mixturePlanes(const std::vector<MixturePoint>& points, std::size_t stride) {
  const std::size_t lobes = points.front().lobes.size();
  std::vector<float> planes((6 + 4 * lobes) * stride);
  for (std::size_t i = 0; i < stride; ++i) {
    const MixturePoint& p = points[std::min(i, points.size() - 1)];
    for (int c = 0; c < 3; ++c) {
      const auto plane = static_cast<std::size_t>(c);
      planes[plane * stride + i] = static_cast<float>(p.position[c]);
      planes[(3 + plane) * stride + i] = static_cast<float>(p.view[c]);
    }
    for (std::size_t k = 0; k < lobes; ++k) {
      const reference::GaussianOfNormals& lobe = p.lobes[k];
      const double square = 2 * lobe.deviation * lobe.deviation + glm::dot(lobe.mean, lobe.mean);
      const double moments[] = {1, lobe.mean.x, lobe.mean.y, square};
      for (std::size_t c = 0; c < 4; ++c)
        planes[(6 + 4 * k + c) * stride + i] = static_cast<float>(lobe.weight * moments[c]);
    }
  }
  return planes;
}

const std::vector<float>& mixtureTables() {
  static const std::vector<float> values = [] {
    std::vector<float> both = shippedGgx().values;
    const LtcTable normals = shippedLtcTable(reference::Ndf::kNormals);
    both.insert(both.end(), normals.values.begin(), normals.values.end());
    return both;
  }();
  return values;
}

}  // namespace

std::vector<glm::vec3> lightMixtures(KernelBench& bench, const MaterialParams& material,
                                     const std::vector<AreaLight>& lights,
                                     const std::vector<MixturePoint>& points, int lanes) {
  const std::size_t stride = paddedCount(points.size());
  std::size_t vertices = 3;
  for (const AreaLight& light : lights) vertices = std::max(vertices, light.vertices.size());
  Buffer out(bench.device, 3 * stride * 4, BufferPurpose::kProbe);
  const std::vector<KernelArg> args = {probeData(bench, mixturePlanes(points, stride)),
                                       probeData(bench, std::vector{material}),
                                       probeData(bench, prepareAreaLights(lights, glm::dvec3(0))),
                                       probeData(bench, mixtureTables()),
                                       out,
                                       static_cast<std::uint32_t>(lights.size()),
                                       static_cast<std::uint32_t>(shippedGgx().size),
                                       static_cast<std::uint32_t>(stride)};
  probeKernel(bench, "probes/probe_area_mixture.cl", "probeAreaMixture",
              fmt::format("-D WIDTH={} -D LTC=1 -D NORMAL_MAP=1 -D LTC_METHOD={} -D LOBES={} "
                          "-D LIGHT_VERTICES={} -D DIFFUSE={:d} -D ALBEDO_SCALING={:d}",
                          lanes, static_cast<int>(LtcMethod::kMixture), points.front().lobes.size(),
                          vertices, material.surface.albedo.x > 0,
                          material.surface.albedo.x > 0 && material.surface.intensity > 0))
      .launch(args, stride / static_cast<std::size_t>(lanes), kLocalSize);
  std::vector<float> values(3 * stride);
  out.read(values.data(), values.size() * 4);
  std::vector<glm::vec3> result;
  for (std::size_t i = 0; i < points.size(); ++i)
    result.emplace_back(values[i], values[stride + i], values[2 * stride + i]);
  return result;
}

}  // namespace glintmark
