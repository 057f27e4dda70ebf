// Peak arithmetic and bandwidth of a device, by kernels/probes/probe.cl.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <string>

#include "host/core/error.h"
#include "host/ocl/compute.h"
#include "host/ocl/device_clock.h"

namespace glintmark {
namespace {

constexpr double kFlopsPerRoundAndLane = 2.0 * 12.0;  // twelve FMA chains
constexpr std::uint32_t kFirstRounds = 256;           // long enough for every chain to settle
constexpr std::uint32_t kMaxRounds = 1u << 28;
constexpr double kLaunchNs = 6e6;  // long beside the cost of a launch, short beside a preemption

// Launches this long are mostly kernel: a clock that says less than this share of each of them
// counts something else than nanoseconds. On a machine with other work some wait for processors,
// not all.
constexpr double kTrialNs = 25e6;
constexpr int kTrials = 6;
constexpr double kLeastShare = 0.25;

constexpr int kFmaPatience = 24;
constexpr int kTriadPatience = 5;
constexpr int kMaxRepetitions = 100;

constexpr std::size_t kMebibyte = std::size_t{1} << 20;
constexpr std::size_t kMinArrayBytes = 32 * kMebibyte;
constexpr std::size_t kArrayStep = std::size_t{1} << 16;  // whole vectors and groups
constexpr std::size_t kTriadLocalSize = 256;

// No device passes these. A compute unit is a core or, on the largest GPUs, a few hundred lanes of
// two operations each; its clock may be stated as 0, or at rest.
constexpr double kMostFlopsPerUnitAndCycle = 1024;
constexpr double kMostGhz = 8;
constexpr double kMostGbs = 1e5;

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

struct FmaProbe {
  Kernel kernel;
  Buffer values;
  std::size_t items = 0, local_size = 1;
  std::uint32_t rounds = kFirstRounds;

  LaunchTimes launch() {
    const std::array<KernelArg, 4> args = {values, rounds, 0.5f, 0.5f};
    return kernel.launch(args, items, local_size);
  }
  // Doubles the rounds until two launches take `wall_ns` each. The wall clock alone decides: a
  // device's may stand still.
  void lengthenTo(double wall_ns) {
    while (rounds < kMaxRounds && (launch().wall_ns < wall_ns || launch().wall_ns < wall_ns))
      rounds *= 2;
  }
};

FmaProbe makeFmaProbe(Device& device, const Program& program, int lanes) {
  const DeviceInfo& info = device.info();
  FmaProbe probe;
  probe.kernel = program.kernel("probeFma");
  // A CPU needs many more groups than threads to even out; a GPU needs every scheduler slot full.
  probe.local_size = info.is_cpu ? 8 : 256;
  probe.items = probe.local_size * std::max(info.compute_units, 1u) * 32;
  probe.values = Buffer(device, probe.items * static_cast<std::size_t>(lanes) * sizeof(float),
                        BufferPurpose::kProbe, "the FMA probe");
  probe.values.fillZero();
  probe.launch();
  return probe;
}

// Gives a clock up that is slow beside the wall's.
void tryClock(DeviceClock& clock, FmaProbe probe) {
  probe.lengthenTo(kTrialNs);
  LaunchTimes best;
  for (int i = 0; i < kTrials; ++i) {
    const LaunchTimes times = probe.launch();
    if (i == 0 || times.event_ns * best.wall_ns > best.event_ns * times.wall_ns) best = times;
  }
  if (best.event_ns < kLeastShare * best.wall_ns)
    clock.distrust(
        fmt::format("it says {:.3g} ms for launches that take {:.3g} ms by the wall clock",
                    best.event_ns * 1e-6, best.wall_ns * 1e-6));
}

double measureGflops(Device& device, const Program& program, int lanes) {
  FmaProbe probe = makeFmaProbe(device, program, lanes);
  if (device.clock().wantsTrial()) tryClock(device.clock(), probe);
  probe.lengthenTo(kLaunchNs);
  const double best_ns = bestEventNs(kFmaPatience, [&] { return probe.launch(); });

  float answer = 0;
  probe.values.read(&answer, sizeof answer);
  checkAnswer(answer, 12.0f, "FMA", device.info());
  return kFlopsPerRoundAndLane * lanes * static_cast<double>(probe.rounds) *
         static_cast<double>(probe.items) / best_ns;
}

// Three arrays that together are four times the cache, as STREAM asks for, within the device's
// limits.
std::size_t triadArrayBytes(const DeviceInfo& info) {
  std::size_t bytes = std::max<std::size_t>(info.cache_bytes * 4 / 3, kMinArrayBytes);
  if (info.max_alloc_bytes > 0) bytes = std::min<std::size_t>(bytes, info.max_alloc_bytes);
  if (info.global_mem_bytes > 0) bytes = std::min<std::size_t>(bytes, info.global_mem_bytes / 8);
  return std::max<std::size_t>(bytes / kArrayStep, 1) * kArrayStep;
}

double measureGbs(Device& device, const Program& program, int lanes) {
  const DeviceInfo& info = device.info();
  const std::size_t bytes = triadArrayBytes(info);
  const auto count =
      static_cast<std::uint32_t>(bytes / sizeof(float) / static_cast<std::size_t>(lanes));
  const std::size_t local_size = kTriadLocalSize;
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

// What makes these peaks impossible, or nothing.
std::string impossible(const DevicePeaks& peaks, const DeviceInfo& info) {
  const double ghz = std::max(info.max_clock_mhz * 1e-3, kMostGhz);
  if (peaks.gflops > kMostFlopsPerUnitAndCycle * ghz * std::max(info.compute_units, 1u))
    return fmt::format("makes a peak of {:.3g} GFLOP/s of {} compute units", peaks.gflops,
                       info.compute_units);
  if (peaks.gbs > kMostGbs) return fmt::format("makes a bandwidth of {:.3g} GB/s", peaks.gbs);
  return "";
}

}  // namespace

DevicePeaks measurePeaks(Device& device, ProgramCache& cache, int lanes) {
  KernelConfig config;
  config.width = lanes;
  const Program program = cache.get("probes/probe.cl", config);
  while (true) {
    const Timer timer = device.clock().timer();
    const DevicePeaks peaks = {measureGflops(device, program, lanes),
                               measureGbs(device, program, lanes)};
    const std::string fault = impossible(peaks, device.info());
    if (!fault.empty() && timer == Timer::kWall)
      throw Error(fmt::format("the wall clock {} on '{}', so its peaks are unknown", fault,
                              device.info().name),
                  kExitCheckFailed);
    if (!fault.empty()) device.clock().distrust("it " + fault);
    if (device.clock().timer() == timer) return peaks;
  }
}

}  // namespace glintmark
