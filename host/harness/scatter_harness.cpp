#include "host/harness/scatter_harness.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/frame/effect/scattering_params.h"

namespace glintmark {
glm::dvec3 directionAt(double cosine, double azimuth_rad) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(azimuth_rad), sine * std::sin(azimuth_rad), cosine};
}

std::vector<DirectionPair> denseDirections() {
  std::vector<double> cosines = {0, 1e-7, 1e-4, 0.01, 0.02, 0.05};
  for (int i = 1; i <= 20; ++i) cosines.push_back(i / 20.0);
  std::vector<DirectionPair> pairs;
  for (const double in : cosines)
    for (const double out : cosines)
      for (const double azimuth : {0.0, 1.0, std::numbers::pi / 2, 2.5, std::numbers::pi})
        pairs.push_back({directionAt(in, 0), directionAt(out, azimuth)});
  return pairs;
}

Material roughMaterial(DiffuseModel model, double alpha, double albedo, double masking) {
  Material material;
  const auto a = static_cast<float>(albedo);
  material.params.surface.albedo = {a, a, a, 0};
  material.diffuse_model = model;
  material.diffuse_roughness = alpha;
  material.diffuse_masking = masking;
  return material;
}

std::vector<ScatteredRadiance> probeScatter(KernelBench& bench,
                                            const std::vector<DirectionPair>& pairs,
                                            const Material& material, int lanes,
                                            bool masking_compiled_in) {
  KernelConfig config;
  config.width = lanes;
  config.glint = false;
  config.diffuse = true;
  config.multiscatter = static_cast<Multiscatter>(material.diffuse_model);
  config.lobe_masking = masking_compiled_in || material.diffuse_masking > 0;
  const std::size_t n = paddedCount(pairs.size());
  std::vector<float> in(6 * n), out(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const DirectionPair& pair = pairs[std::min(i, pairs.size() - 1)];
    for (int k = 0; k < 3; ++k) {
      in[static_cast<std::size_t>(k) * n + i] = static_cast<float>(pair.light[k]);
      in[static_cast<std::size_t>(k + 3) * n + i] = static_cast<float>(pair.view[k]);
    }
  }
  const MultiscatterMaterial prepared = prepareMultiscatter(material, config);
  Buffer output(bench.device, out.size() * 4, BufferPurpose::kProbe, "radiance");
  const std::vector<KernelArg> args = {
      probeData(bench, in, "directions"),
      probeData(bench, std::vector{prepared}, "a material's scattering"), output,
      static_cast<std::uint32_t>(n)};
  probeKernel(bench, "probes/probe_scatter.cl", "probeScatter", buildOptions(config))
      .launch(args, n / static_cast<std::size_t>(lanes), kLocalSize);
  output.read(out.data(), out.size() * 4);
  std::vector<ScatteredRadiance> result;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    result.push_back({out[i] * prepared.single.x, out[n + i] * prepared.multiple.x});
  return result;
}

}  // namespace glintmark
