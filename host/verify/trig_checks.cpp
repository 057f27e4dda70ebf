// Sine, cosine and angle of wide_trig.clh, all around.
#include <algorithm>
#include <cmath>
#include <random>

#include "host/core/angles.h"
#include "host/harness/kernel_bench.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

Finding turns(const CheckContext& context) {
  constexpr std::size_t kCount = 1 << 14;
  std::mt19937 random(4);
  std::vector<float> in(3 * kCount), out(3 * kCount);
  for (std::size_t i = 0; i < kCount; ++i) {
    in[i] = static_cast<float>(i) / (kCount - 1);
    // Vectors of all quadrants, on the axes too, from tiny to huge.
    const double angle = i < 16 ? static_cast<double>(i) / 8 * kPi
                                : 2 * kPi * static_cast<double>(random()) * 0x1p-32;
    const double length = std::exp2(static_cast<double>(i % 41) - 20);
    in[kCount + i] = static_cast<float>(length * std::cos(angle));
    in[2 * kCount + i] = static_cast<float>(length * std::sin(angle));
  }
  Buffer output(context.bench.device, out.size() * 4, BufferPurpose::kProbe, "angles");
  const std::vector<KernelArg> args = {probeData(context.bench, in), output,
                                       static_cast<std::uint32_t>(kCount)};
  probeKernel(context.bench, "probes/probe_trig.cl", "probeTrig",
              "-D WIDTH=" + std::to_string(context.lanes))
      .launch(args, kCount / static_cast<std::size_t>(context.lanes), kLocalSize);
  output.read(out.data(), out.size() * 4);
  Finding finding(1);
  for (std::size_t i = 0; i < kCount; ++i) {
    const double t = 2 * kPi * in[i];
    finding.add(std::abs(out[i] - std::sin(t)) / kSineError);
    finding.add(std::abs(out[kCount + i] - std::cos(t)) / kSineError);
    const double want = std::atan2(in[2 * kCount + i], in[kCount + i]) / (2 * kPi);
    const double apart = std::abs(out[2 * kCount + i] - want);
    finding.add(std::abs(apart - std::round(apart)) / kAngleError);  // 0 and 1 are one angle
    finding.require(out[2 * kCount + i] >= 0 && out[2 * kCount + i] <= 1, "angles are 0 to 1");
  }
  return finding;
}

}  // namespace

std::vector<Check> trigChecks() {
  return {{"maths/turns", "error in units of its bound", turns}};
}

}  // namespace glintmark
