#include "host/ocl/trial.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <vector>

#include "host/core/error.h"
#include "host/ocl/upload.h"

namespace glintmark {
namespace {

// Above 2^16 work-items of one lane, where PoCL has other code than below.
constexpr std::uint32_t kValues = 3u << 15;
constexpr std::uint32_t kStep = 1024;  // whole groups of every width
constexpr std::size_t kLocalSize = 64;

std::uint32_t valuesFor(const DeviceInfo& info) {
  if (info.max_alloc_bytes == 0 || info.max_alloc_bytes >= kValues * sizeof(float)) return kValues;
  const auto fitting = static_cast<std::uint32_t>(info.max_alloc_bytes / sizeof(float));
  return std::max(1u, fitting / kStep) * kStep;
}

}  // namespace

void tryDevice(Device& device, int lanes) {
  KernelConfig config;
  config.width = lanes;
  ProgramCache cache(device);
  Kernel triad = cache.get("probes/probe.cl", config).kernel("probeTriad");
  const std::uint32_t values = valuesFor(device.info());
  std::vector<float> b(values), c(values), a(values);
  for (std::uint32_t i = 0; i < values; ++i) {
    b[i] = static_cast<float>(i + 1);
    c[i] = static_cast<float>(i * 7 % 1021);
  }
  const BufferPurpose probe = BufferPurpose::kProbe;
  const Buffer sums = upload(device, a, probe, "the trial's sums");
  const std::uint32_t count = values / static_cast<std::uint32_t>(lanes);
  triad.launch(
      std::array<KernelArg, 5>{sums, upload(device, b, probe, "the trial's numbers"),
                               upload(device, c, probe, "the trial's numbers"), 3.0f, count},
      count, kLocalSize);
  sums.read(a.data(), a.size() * sizeof(float));
  std::size_t wrong = 0, first = 0;
  for (std::size_t i = values; i-- > 0;)
    if (std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i] + 3 * c[i])) {
      ++wrong;
      first = i;
    }
  if (wrong == 0) return;
  throw DeviceError(fmt::format(
      "'{}' computes wrongly at {} {}: {} of {} sums, the first {} + 3 * {} = {}; glintmark verify "
      "shows what else is wrong with it",
      device.info().name, lanes, lanes == 1 ? "lane" : "lanes", wrong, values, b[first], c[first],
      a[first]));
}

}  // namespace glintmark
