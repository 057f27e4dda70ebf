// What every other check stands on: structs of the same layout, and arithmetic that is IEEE's.
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "host/core/shared_types.h"
#include "host/harness/pixel_harness.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

template <std::size_t N>
void addDifferences(KernelBench& bench, Finding& finding, const char* kernel,
                    const std::array<std::uint32_t, N>& wanted) {
  Buffer out(bench.device, N * 4, BufferPurpose::kProbe);
  const KernelArg args[] = {out};
  probeKernel(bench, "probes/probe.cl", kernel, "").launch(args, 1, 1);
  std::array<std::uint32_t, N> values{};
  out.read(values.data(), N * 4);
  for (std::size_t i = 0; i < N; ++i)
    finding.add(std::abs(static_cast<double>(values[i]) - static_cast<double>(wanted[i])));
}

Finding structLayouts(const CheckContext& context) {
  Finding finding(0);
  addDifferences<kSharedTypeSizes.size()>(context.bench, finding, "probeTypeSizes",
                                          kSharedTypeSizes);
  constexpr std::array<std::uint32_t, 10> kOffsets = {
      offsetof(MaterialParams, glints.alpha_l),
      offsetof(MaterialParams, glints.density),
      offsetof(MaterialParams, glints.palette_count),
      offsetof(MaterialParams, surface.f0),
      offsetof(MaterialParams, glints.palette),
      offsetof(ConeLight, irradiance),
      offsetof(LightParams, one_minus_cos),
      offsetof(LightParams, cotangent),
      offsetof(FrameParams, light_count),
      offsetof(FrameParams, plane_stride)};
  addDifferences<kOffsets.size()>(context.bench, finding, "probeTypeOffsets", kOffsets);
  return finding;
}

// Twelve chains of x = x / 2 + 1 / 2 end at exactly 1 each.
Finding fusedMultiplyAdds(const CheckContext& context) {
  std::vector<float> values(64, 0.25f);
  const Buffer buffer = probeData(context.bench, values);
  const KernelArg args[] = {buffer, std::uint32_t{200}, 0.5f, 0.5f};
  probeKernel(context.bench, "probes/probe.cl", "probeFma",
              "-D WIDTH=" + std::to_string(context.lanes))
      .launch(args, values.size() / static_cast<std::size_t>(context.lanes), 1);
  buffer.read(values.data(), values.size() * 4);
  Finding finding(0);
  for (const float value : values) finding.add(std::abs(value - 12.0));
  return finding;
}

}  // namespace

std::vector<Check> deviceChecks() {
  return {{"device/structs", "bytes of difference in size or offset", structLayouts},
          {"device/fma", "error of chains that end at 12", fusedMultiplyAdds}};
}

}  // namespace glintmark
