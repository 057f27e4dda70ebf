// Peak arithmetic and bandwidth of a device, by kernels/probes/probe.cl.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>

#include "host/core/error.h"
#include "host/ocl/compute.h"

namespace glintmark {
namespace {

constexpr double kFlopsPerRoundAndLane = 2.0 * 12.0;  // twelve FMA chains
constexpr std::uint32_t kFirstRounds = 256;           // long enough for every chain to settle
constexpr std::uint32_t kMaxRounds = 1u << 28;
constexpr double kLaunchNs = 6e6;  // long beside the cost of a launch, short beside a preemption
constexpr int kFmaPatience = 24;
constexpr int kTriadPatience = 5;
constexpr int kMaxRepetitions = 100;

constexpr std::size_t kMebibyte = std::size_t{1} << 20;
constexpr std::size_t kMinArrayBytes = 32 * kMebibyte;

// Fastest launch: what disturbs one can only slow it down. Goes on until `patience` launches in a
// row were no faster by 1%, because clocks and schedulers take their time to settle.
double bestEventNs(int patience, const std::function<LaunchTimes()>& launch) {
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0, since_best = 0; i < kMaxRepetitions && since_best < patience; ++i, ++since_best) {
    const double event_ns = launch().event_ns;
    if (event_ns < 0.99 * best) since_best = 0;
    best = std::min(best, event_ns);
  }
  return std::max(best, 1.0);
}

void checkAnswer(float value, float expected, const char* probe, const DeviceInfo& info) {
  if (value != expected)
    throw Error(fmt::format("the {} probe gave {} instead of {} on '{}', so its peak is unknown",
                            probe, value, expected, info.name),
                kExitCheckFailed);
}

double measureGflops(Device& device, const Program& program, int lanes) {
  const DeviceInfo& info = device.info();
  // A CPU needs many more groups than threads to even out; a GPU needs every scheduler slot full.
  const std::size_t local_size =
      std::min<std::size_t>(info.is_cpu ? 8 : 256, info.max_work_group_size);
  const std::size_t items = local_size * std::max(info.compute_units, 1u) * 32;
  Buffer values(device, items * static_cast<std::size_t>(lanes) * sizeof(float),
                BufferPurpose::kProbe, "the FMA probe");
  values.fillZero();

  Kernel kernel = program.kernel("probeFma");
  std::uint32_t rounds = kFirstRounds;
  const auto launch = [&] {
    const std::array<KernelArg, 4> args = {values, rounds, 0.5f, 0.5f};
    return kernel.launch(args, items, local_size);
  };
  launch();
  while (rounds < kMaxRounds && launch().event_ns < kLaunchNs) rounds *= 2;
  const double best_ns = bestEventNs(kFmaPatience, launch);

  float answer = 0;
  values.read(&answer, sizeof answer);
  checkAnswer(answer, 12.0f, "FMA", info);
  return kFlopsPerRoundAndLane * lanes * static_cast<double>(rounds) * static_cast<double>(items) /
         best_ns;
}

// Three arrays that together are four times the cache, as STREAM asks for, within the device's
// limits.
std::size_t triadArrayBytes(const DeviceInfo& info) {
  const std::size_t wanted = std::max<std::size_t>(info.cache_bytes * 4 / 3, kMinArrayBytes);
  const std::size_t limit = std::min<std::size_t>(info.max_alloc_bytes, info.global_mem_bytes / 8);
  return std::min(wanted, limit) / kMebibyte * kMebibyte;
}

double measureGbs(Device& device, const Program& program, int lanes) {
  const DeviceInfo& info = device.info();
  const std::size_t bytes = triadArrayBytes(info);
  const auto count =
      static_cast<std::uint32_t>(bytes / sizeof(float) / static_cast<std::size_t>(lanes));
  const std::size_t local_size = std::min(256u, info.max_work_group_size);
  Buffer a(device, bytes, BufferPurpose::kProbe, "the bandwidth probe"),
      b(device, bytes, BufferPurpose::kProbe, "the bandwidth probe"),
      c(device, bytes, BufferPurpose::kProbe, "the bandwidth probe");

  Kernel fill = program.kernel("probeFill");
  fill.launch(std::array<KernelArg, 3>{a, 0.0f, count}, count, local_size);
  fill.launch(std::array<KernelArg, 3>{b, 1.0f, count}, count, local_size);
  fill.launch(std::array<KernelArg, 3>{c, 2.0f, count}, count, local_size);

  Kernel triad = program.kernel("probeTriad");
  const std::array<KernelArg, 5> args = {a, b, c, 3.0f, count};
  const auto launch = [&] { return triad.launch(args, count, local_size); };
  launch();
  const double best_ns = bestEventNs(kTriadPatience, launch);

  float answer = 0;
  a.read(&answer, sizeof answer, bytes - sizeof answer);
  checkAnswer(answer, 7.0f, "bandwidth", info);
  return 3.0 * static_cast<double>(bytes) / best_ns;
}

}  // namespace

DevicePeaks measurePeaks(Device& device, ProgramCache& cache, int lanes) {
  KernelConfig config;
  config.width = lanes;
  const Program program = cache.get("probes/probe.cl", config);
  DevicePeaks peaks;
  peaks.gflops = measureGflops(device, program, lanes);
  peaks.gbs = measureGbs(device, program, lanes);
  return peaks;
}

}  // namespace glintmark
