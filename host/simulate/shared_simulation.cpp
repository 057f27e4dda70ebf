#include "host/simulate/shared_simulation.h"

#include <algorithm>
#include <array>

#include "host/core/stopwatch.h"

namespace glintmark {

SharedSimulation::SharedSimulation(const Ranks& ranks, Simulator& simulator,
                                   const Simulation& simulation)
    : ranks_(ranks),
      simulator_(simulator),
      simulation_(simulation),
      counts_(HF_HISTOGRAM_WORDS, 0),
      cast_(simulation.rays_done) {
  simulation_.histogram.resize(HF_HISTOGRAM_WORDS);
  simulator_.prepare(simulation.settings);
}

bool SharedSimulation::advance(bool stop) {
  const SimulationSettings& settings = simulation_.settings;
  const std::uint64_t first = cast_ / kRaysPerSurface, all = surfaceCount(settings.rays);
  const std::uint64_t end =
      std::min(all, first + each_ * static_cast<std::uint64_t>(ranks_.size()));
  const Stopwatch watch;
  for (std::uint64_t i = first; i < end; ++i)
    if (ranks_.makes(i)) simulator_.castSurface(settings, i, counts_);
  cast_ = std::min(end * kRaysPerSurface, settings.rays);
  // Signals, and the mean time of a round, from which all derive the same length of the next.
  std::array<std::uint64_t, 2> sums = {stop ? 1u : 0u,
                                       static_cast<std::uint64_t>(watch.elapsedNs())};
  ranks_.sum(sums);
  const double round_s = 1e-9 * static_cast<double>(sums[1]) / static_cast<double>(ranks_.size());
  const double surface_s = std::max(round_s / static_cast<double>(each_), 1e-6);
  each_ = static_cast<std::uint64_t>(std::max(1.0, kRound_s / surface_s));
  return sums[0] > 0;
}

void SharedSimulation::collect() {
  ranks_.sumAtFirst(counts_);
  for (std::size_t i = 0; i < counts_.size(); ++i) simulation_.histogram[i] += counts_[i];
  std::ranges::fill(counts_, 0);
  simulation_.rays_done = cast_;
}

bool SharedSimulation::castLast() const {
  return cast_ > 0 && ranks_.makes(surfaceCount(cast_) - 1);
}

Simulation simulateShared(const Ranks& ranks, Simulator& simulator,
                          const SimulationSettings& settings, const std::function<void()>& stop) {
  SharedSimulation shared(ranks, simulator, {settings, 0, {}});
  while (!shared.isDone()) {
    stop();
    shared.advance(false);
  }
  shared.collect();
  Simulation whole = shared.collected();
  if (!ranks.isFirst()) std::ranges::fill(whole.histogram, 0);
  ranks.sum(whole.histogram);
  return whole;
}

}  // namespace glintmark
