#include "host/simulate/simulation_file.h"

#include <fmt/format.h>

#include <charconv>
#include <numeric>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr const char* kFormat = "glintmark.simulation/1";
constexpr std::size_t kWordBytes = 8;

// The next line of `text` from `position` on, which moves behind it; empty at the end.
std::string takeLine(const std::string& text, std::size_t& position) {
  const std::size_t end = text.find('\n', position);
  if (end == std::string::npos) return "";
  std::string line = text.substr(position, end - position);
  position = end + 1;
  return line;
}

}  // namespace

std::string describeSettings(const SimulationSettings& s) {
  constexpr const char* kKinds[] = {"diffuse", "metal", "dielectric"};
  std::string text =
      fmt::format("{}{} alpha={},{} incidence={} azimuth={} orders={} seed={}",
                  s.model == SurfaceModel::kSmith ? "smith " : "", kKinds[static_cast<int>(s.kind)],
                  s.alpha.x, s.alpha.y, s.incidence_deg, s.azimuth_deg, s.orders, s.seed);
  if (s.model == SurfaceModel::kHeights) text += fmt::format(" l={}", s.correlation_texels);
  if (s.f0) {
    text += fmt::format(" f0={} tint={}", *s.f0, s.tint);
  } else {
    if (s.kind != SurfaceKind::kDiffuse) text += fmt::format(" n={}", s.index_n);
    if (s.kind == SurfaceKind::kMetal) text += fmt::format(" k={}", s.index_k);
  }
  if (s.last_bounce_leaves) text += " last-bounce-leaves";
  return text;
}

std::string packSimulation(const Simulation& simulation) {
  std::string text = fmt::format("{}\n{}\n{}\n", kFormat, describeSettings(simulation.settings),
                                 simulation.rays_done);
  for (const std::uint64_t count : simulation.histogram)
    for (std::size_t byte = 0; byte < kWordBytes; ++byte)
      text += static_cast<char>(count >> (8 * byte) & 0xFF);
  return text;
}

Simulation unpackSimulation(const std::string& text, const SimulationSettings& settings,
                            const std::string& source) {
  std::size_t position = 0;
  if (takeLine(text, position) != kFormat)
    throw Error(fmt::format("{} is not a checkpoint of glintmark simulate", source));
  const std::string theirs = takeLine(text, position), ours = describeSettings(settings);
  if (theirs != ours)
    throw Error(fmt::format("{} is the checkpoint of another run ({}); this one is {}", source,
                            theirs, ours));
  Simulation simulation{settings, 0, {}};
  const std::string rays = takeLine(text, position);
  const auto parsed = std::from_chars(rays.data(), rays.data() + rays.size(), simulation.rays_done);
  if (parsed.ec != std::errc() ||
      text.size() - position != std::size_t{HF_HISTOGRAM_WORDS} * kWordBytes)
    throw Error(fmt::format("{} is damaged; start again without --resume", source));
  simulation.histogram.resize(HF_HISTOGRAM_WORDS);
  for (std::uint64_t& count : simulation.histogram)
    for (std::size_t byte = 0; byte < kWordBytes; ++byte)
      count |= std::uint64_t{static_cast<unsigned char>(text[position++])} << (8 * byte);
  const std::uint64_t total =
      std::accumulate(simulation.histogram.begin(), simulation.histogram.end(), std::uint64_t{0});
  if (total != simulation.rays_done)
    throw Error(fmt::format("{} is damaged: it counts {} of {} rays; start again without --resume",
                            source, total, simulation.rays_done));
  const bool whole = simulation.rays_done % kRaysPerSurface == 0;
  if (simulation.rays_done > settings.rays || (!whole && simulation.rays_done < settings.rays))
    throw Error(fmt::format("{} holds {} rays, which a run of {} cannot carry on with; ask for {}",
                            source, simulation.rays_done, settings.rays,
                            whole ? "more" : "just as many"));
  return simulation;
}

}  // namespace glintmark
