#include "host/experiment/frame_timing.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <functional>

#include "host/report/metrics.h"

namespace glintmark {
namespace {

constexpr int kMostRounds = 101;

template <typename Combine>
Samples combined(const TurnTimes& times, Combine combine) {
  Samples result;
  std::ranges::transform(times.first_ms, times.second_ms, std::back_inserter(result), combine);
  return result;
}

}  // namespace

std::unique_ptr<FrameRenderer> preparedFrame(BenchRun& run, const Scene& scene, const View& view,
                                             const ShadingOptions& options,
                                             std::shared_ptr<NormalTextures> textures) {
  stopIfInterrupted();
  auto renderer = std::make_unique<FrameRenderer>(run.device(), scene, view, options, run.threads(),
                                                  std::move(textures));
  renderer->prepare();
  for (int frame = 0; frame < run.options().warmup; ++frame) renderer->shade();
  return renderer;
}

std::string kernelOptions(const FrameRenderer& renderer) {
  std::vector<std::string> options;
  for (const KernelConfig& config : renderer.configs()) options.push_back(buildOptions(config));
  return fmt::format("{}", fmt::join(options, " | "));
}

void invalidateIfFaulty(std::vector<Record>& records, const Image& radiance) {
  const std::string fault = radianceFault(radiance);
  if (fault.empty()) return;
  for (Record& record : records) {
    record.valid = false;
    record.note = "not valid: " + fault;
  }
}

double shadeMs(FrameRenderer& renderer) {
  stopIfInterrupted();
  return renderer.shade().shading_event_ns * kMsPerNs;
}

Samples shadeTimesMs(FrameRenderer& renderer, const Repetitions& reps) {
  Samples times_ms;
  while (reps.wantsMore({&times_ms})) times_ms.push_back(shadeMs(renderer));
  return times_ms;
}

Samples TurnTimes::ratios() const {
  return combined(*this, std::divides<>());
}

Samples TurnTimes::differences() const {
  return combined(*this, std::minus<>());
}

TurnTimes shadeInTurn(FrameRenderer& first, FrameRenderer& second, const Repetitions& reps) {
  TurnTimes times;
  while (reps.wantsMore({&times.first_ms, &times.second_ms})) {
    times.first_ms.push_back(shadeMs(first));
    times.second_ms.push_back(shadeMs(second));
  }
  return times;
}

std::vector<Samples> shadeInTurn(std::span<const std::unique_ptr<FrameRenderer>> renderers,
                                 const Repetitions& reps) {
  std::vector<Samples> times_ms(renderers.size());
  while (reps.wantsMore(times_ms))
    for (std::size_t i = 0; i < renderers.size(); ++i)
      times_ms[i].push_back(shadeMs(*renderers[i]));
  return times_ms;
}

int lastingReps(FrameRenderer& first, FrameRenderer& second, int reps) {
  const double pair_ms = shadeMs(first) + shadeMs(second);
  return std::max(reps, static_cast<int>(std::min<double>(kMostRounds, kLeastTime_ms / pair_ms)));
}

}  // namespace glintmark
