#include "host/simulate/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/core/error.h"
#include "host/core/float4.h"

namespace glintmark {
namespace {

constexpr double kLeastAlpha = 1e-4, kMostAlpha = 2;
constexpr double kMostIncidence_deg = 89.95;
// Rays of one work-item: enough to keep the lanes full on a processor, few on a GPU, which needs
// many items.
constexpr int kMostLanes = 16, kGroups = 2;
constexpr std::uint32_t kRaysPerCpuItem = 4096, kRaysPerGpuItem = 32;
constexpr std::size_t kCpuLocalSize = 4, kGpuLocalSize = 64;

std::uint32_t raysPerItem(const Device& device) {
  return device.info().is_cpu ? kRaysPerCpuItem : kRaysPerGpuItem;
}

// Lanes of a work-item: kernels of several lanes have two groups of them.
std::uint32_t laneCount(int lanes) {
  return static_cast<std::uint32_t>(lanes > 1 ? kGroups * lanes : 1);
}

void requireRange(const char* what, double value, double low, double high) {
  if (!(value >= low && value <= high))
    throw Error(fmt::format("{} {} is out of range; it must be {} to {}", what, value, low, high));
}

// Different for every surface of every run.
std::uint32_t launchSeed(std::uint32_t seed, std::uint64_t surface) {
  std::uint64_t h = (std::uint64_t{seed} << 32 | 0x5DEECE66u) ^ (surface * 0x9E3779B97F4A7C15u);
  h = (h ^ (h >> 31)) * 0xD6E8FEB86659FD93u;
  h = (h ^ (h >> 32)) * 0xD6E8FEB86659FD93u;
  return static_cast<std::uint32_t>(h >> 32);
}

std::size_t cellIndex(int side, int order, std::size_t cosine, std::size_t azimuth) {
  const auto block =
      static_cast<std::size_t>(side) * HF_MAX_ORDERS + static_cast<std::size_t>(order - 1);
  return (block * HF_COSINES + cosine) * HF_AZIMUTHS + azimuth;
}

// What Schlick's term loses, over mu (1 - mu)^6, for `tint` times as much to be left at mu = 1 / 7.
double dipOf(double f0, double tint) {
  constexpr double kCosine = 1.0 / 7;
  const double schlick = f0 + (1 - f0) * std::pow(1 - kCosine, 5);
  return schlick * (1 - tint) / (kCosine * std::pow(1 - kCosine, 6));
}

HeightfieldRun makeRun(const SimulationSettings& s, float count_height,
                       std::uint32_t rays_per_lane) {
  const glm::dvec3 light = incidentDirection(s);
  HeightfieldRun run{};
  run.incoming = toFloat4(-light);
  run.alpha = {static_cast<float>(s.alpha.x), static_cast<float>(s.alpha.y)};
  run.count_height = count_height;
  run.index_n = static_cast<float>(s.index_n);
  run.index_k = static_cast<float>(s.index_k);
  if (s.f0) {
    run.f0 = static_cast<float>(*s.f0);
    run.dip = static_cast<float>(dipOf(*s.f0, s.tint));
  }
  run.orders = static_cast<uint>(s.orders);
  run.rays_per_lane = rays_per_lane;
  return run;
}

}  // namespace

void validate(const SimulationSettings& s) {
  requireRange("roughness along x", s.alpha.x, kLeastAlpha, kMostAlpha);
  requireRange("roughness along y", s.alpha.y, kLeastAlpha, kMostAlpha);
  requireRange("incidence [degrees]", s.incidence_deg, 0, kMostIncidence_deg);
  requireRange("azimuth [degrees]", s.azimuth_deg, -360, 360);
  requireRange("number of orders", s.orders, 1, HF_MAX_ORDERS);
  if (s.kind != SurfaceKind::kDiffuse) requireRange("index of refraction n", s.index_n, 0.05, 20);
  if (s.kind == SurfaceKind::kDielectric && std::abs(s.index_n - 1) < 1e-3)
    throw Error(
        fmt::format("index of refraction {} of a dielectric is that of air; it must differ "
                    "from 1 by 0.001 or more",
                    s.index_n));
  if (s.kind == SurfaceKind::kMetal)
    requireRange("imaginary index of refraction k", s.index_k, 0, 1000);
  if (s.f0 && s.kind != SurfaceKind::kMetal)
    throw Error("a reflectance f0 is of metals; others have an index of refraction");
  if (s.f0) requireRange("reflectance f0", *s.f0, 1e-3, 1);
  requireRange("tint", s.tint, 0, 1);
  if (s.tint != 1 && !s.f0) throw Error("a tint is of metals by their f0; give that too");
  if (s.model == SurfaceModel::kSmith && s.kind == SurfaceKind::kDielectric)
    throw Error("Smith's walk is of diffuse surfaces and metals; choose one of those, or heights");
  if (s.model == SurfaceModel::kSmith && s.last_bounce_leaves)
    throw Error("a last bounce that leaves is of heights; Smith's walk has none");
  if (s.rays == 0) throw Error("0 rays are too few; it must be at least 1");
  if (s.rays > (std::uint64_t{1} << 48))
    throw Error(fmt::format("{} rays are too many; it must be at most 2^48", s.rays));
}

glm::dvec3 incidentDirection(const SimulationSettings& s) {
  const double theta = glm::radians(s.incidence_deg), phi = glm::radians(s.azimuth_deg);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

std::string traceOptions(const SimulationSettings& settings, int lanes) {
  return fmt::format("-D WIDTH={} -D SURFACE_KIND={} -D LAST_BOUNCE_LEAVES={:d} -D GROUPS={}{}",
                     lanes, static_cast<int>(settings.kind), settings.last_bounce_leaves,
                     lanes > 1 ? kGroups : 1, settings.f0 ? " -D METAL_FRESNEL=1" : "");
}

std::uint64_t Simulation::left(int side, int order) const {
  const auto begin = histogram.begin() + static_cast<std::ptrdiff_t>(cellIndex(side, order, 0, 0));
  return std::accumulate(begin, begin + HF_CELLS, std::uint64_t{0});
}

std::uint64_t Simulation::absorbed() const {
  const auto begin = histogram.begin() + HF_ABSORBED;
  return std::accumulate(begin, begin + HF_MAX_ORDERS, std::uint64_t{0});
}

std::uint64_t Simulation::leftOver() const {
  return histogram[HF_LEFT_OVER];
}
std::uint64_t Simulation::gaveUp() const {
  return histogram[HF_GAVE_UP];
}

double Simulation::balance() const {
  const std::uint64_t all = std::accumulate(histogram.begin(), histogram.end(), std::uint64_t{0});
  return rays_done > 0 ? static_cast<double>(all) / static_cast<double>(rays_done) : 1;
}

std::uint64_t Simulation::cell(int side, int order, std::size_t cosine, std::size_t azimuth) const {
  return histogram[cellIndex(side, order, cosine, azimuth)];
}

double orderEnergy(const Simulation& simulation, int order, double albedo) {
  if (simulation.rays_done == 0) return 0;
  return std::pow(albedo, order) * static_cast<double>(simulation.left(0, order)) /
         static_cast<double>(simulation.rays_done);
}

Simulator::Simulator(Device& device, ProgramCache& cache, int lanes)
    : device_(device), cache_(cache), lanes_(lanes) {}

void Simulator::prepare(const SimulationSettings& settings) {
  if (!run_.empty() && settings == settings_) return;
  validate(settings);
  const bool heights = settings.model == SurfaceModel::kHeights;
  if (heights && (!surface_ || settings.correlation_texels != surface_correlation_texels_)) {
    surface_ = std::make_unique<SurfaceMaker>(device_, cache_, settings.correlation_texels);
    surface_correlation_texels_ = settings.correlation_texels;
  }
  trace_ = cache_
               .getWithOptions(heights ? "scatter/heightfield.cl" : "scatter/smith_walk.cl",
                               traceOptions(settings, lanes_))
               .kernel(heights ? "traceRays" : "walkRays");
  const auto lanes = heights ? laneCount(lanes_) : static_cast<std::uint32_t>(lanes_);
  const HeightfieldRun run =
      makeRun(settings, heights ? surface_->countHeight() : 0.0f, raysPerItem(device_) / lanes);
  run_ = Buffer(device_, sizeof run, BufferPurpose::kSimulation, "the simulation's parameters");
  run_.write(&run, sizeof run);
  if (outcomes_.empty()) {
    outcomes_ = Buffer(device_, (kRaysPerSurface + kMostLanes) * 4, BufferPurpose::kSimulation,
                       "the rays' outcomes");
    words_.resize(kRaysPerSurface);
  }
  settings_ = settings;
}

void Simulator::launch(const SimulationSettings& settings, std::uint32_t seed, std::uint64_t rays) {
  const std::size_t items = (rays + raysPerItem(device_) - 1) / raysPerItem(device_);
  const std::size_t local_size = device_.info().is_cpu ? kCpuLocalSize : kGpuLocalSize;
  const auto ray_count = static_cast<std::uint32_t>(rays);
  if (settings.model == SurfaceModel::kSmith) {
    const KernelArg args[] = {run_, seed, ray_count, outcomes_};
    trace_ns_ += trace_.launch(args, items, local_size).wall_ns;
    return;
  }
  surface_ns_ += surface_->draw(seed, settings.kind == SurfaceKind::kDielectric);
  const KernelArg args[] = {surface_->heights(), surface_->cones(), run_, seed,
                            ray_count,           outcomes_};
  trace_ns_ += trace_.launch(args, items, local_size).wall_ns;
}

void Simulator::castSurface(const SimulationSettings& settings, std::uint64_t index,
                            std::span<std::uint64_t> histogram) {
  prepare(settings);
  const std::uint64_t rays = std::min(kRaysPerSurface, settings.rays - index * kRaysPerSurface);
  launch(settings, launchSeed(settings.seed, index), rays);
  outcomes_.read(words_.data(), rays * 4);
  for (std::size_t i = 0; i < rays; ++i) ++histogram[words_[i]];
}

void Simulator::advance(Simulation& simulation) {
  const SimulationSettings& settings = simulation.settings;
  prepare(settings);
  simulation.histogram.resize(HF_HISTOGRAM_WORDS);
  if (simulation.rays_done >= settings.rays) return;
  castSurface(settings, simulation.rays_done / kRaysPerSurface, simulation.histogram);
  simulation.rays_done = std::min(simulation.rays_done + kRaysPerSurface, settings.rays);
}

Simulation Simulator::run(const SimulationSettings& settings) {
  Simulation simulation{settings, 0, {}};
  do advance(simulation);
  while (simulation.rays_done < settings.rays);
  return simulation;
}

}  // namespace glintmark
