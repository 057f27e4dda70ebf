// Brute-force scattering at rough surfaces: rays in, histograms of directions out.
// [Heitz 2016] Heitz, Hanika, d'Eon, Dachsbacher, "Multiple-Scattering Microfacet BSDFs with the
// Smith Model", SIGGRAPH 2016.
#pragma once
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "host/ocl/compute.h"
#include "host/simulate/heightfield_types.h"
#include "host/simulate/surface.h"

namespace glintmark {

/// What the rays meet: facets of random heights, or those of Smith's theory, whose heights know
/// nothing of their slopes and of one another [Heitz 2016].
enum class SurfaceModel : int { kHeights = 0, kSmith = 1 };

enum class SurfaceKind : int { kDiffuse = 0, kMetal = 1, kDielectric = 2 };

/// What to simulate. The microfacets' albedo is not among it: of what a diffuse surface of albedo
/// rho reflects at order S, the counts are for rho = 1 and rho^S times as much is left.
struct SimulationSettings {
  SurfaceModel model = SurfaceModel::kHeights;  // Smith's has no dielectrics
  SurfaceKind kind = SurfaceKind::kDiffuse;
  glm::dvec2 alpha{0.8};      // Beckmann roughness along x and y, 1e-4 to 2
  double incidence_deg = 45;  // from the normal, [0, 89.95]
  double azimuth_deg = 0;     // of the light, from +x
  double index_n = 1.5;       // dielectrics and metals: real part of the refractive index
  double index_k = 0;         // metals: imaginary part
  /// Metals: reflectance at normal incidence, (0, 1]. With it they reflect by Schlick's term, in
  /// place of an index, and `tint` times that at 82 degrees, [0, 1].
  std::optional<double> f0{};
  double tint = 1;
  int orders = 4;  // 1 to HF_MAX_ORDERS
  std::uint64_t rays = std::uint64_t{1} << 24;
  std::uint32_t seed = 1;
  double correlation_texels = 3;  // of heights
  /// Rays leave after the last order without shadowing: for tests against closed forms.
  bool last_bounce_leaves = false;

  bool operator==(const SimulationSettings&) const = default;
};

/// Throws Error for a value out of the ranges above.
void validate(const SimulationSettings& settings);

/// Unit vector towards the light.
glm::dvec3 incidentDirection(const SimulationSettings& settings);

/// Counts of a simulation, whole or not.
struct Simulation {
  SimulationSettings settings;
  std::uint64_t rays_done = 0;
  std::vector<std::uint64_t>
      histogram;  // HF_HISTOGRAM_WORDS, layout in kernels/scatter/heightfield.h

  /// Rays that left above (side 0) or below (side 1) after `order` bounces, from 1.
  std::uint64_t left(int side, int order) const;
  std::uint64_t absorbed() const;
  std::uint64_t leftOver() const;  // alive after the last order
  std::uint64_t gaveUp() const;    // lost to the limit of HF_MOST_STEPS cells
  /// Everything counted over the rays; exactly 1 unless the caster loses rays.
  double balance() const;
  /// A cell's count; `cosine` from the normal down, `azimuth` from +x on.
  std::uint64_t cell(int side, int order, std::size_t cosine, std::size_t azimuth) const;
};

/// Share of the energy that leaves above after `order` bounces at microfacet albedo `albedo`.
double orderEnergy(const Simulation& simulation, int order, double albedo = 1);

/// Casts rays on one device. Surfaces are drawn anew every kRaysPerSurface rays.
class Simulator {
 public:
  Simulator(Device& device, ProgramCache& cache, int lanes);

  /// Compiles and allocates what a simulation needs; others do when they first need it. Throws
  /// Error for bad settings.
  void prepare(const SimulationSettings& settings);
  /// Adds the next surface's rays to `simulation`, at most what is missing; does nothing when it is
  /// complete. Results do not depend on where a simulation was interrupted. Throws Error for bad
  /// settings.
  void advance(Simulation& simulation);
  /// Counts the rays of surface `index` of a simulation, of surfaceCount(), in a histogram of
  /// HF_HISTOGRAM_WORDS.
  void castSurface(const SimulationSettings& settings, std::uint64_t index,
                   std::span<std::uint64_t> histogram);
  /// The whole simulation.
  Simulation run(const SimulationSettings& settings);

  /// The last surface of heights; there is none before one was drawn.
  const SurfaceMaker& surface() const { return *surface_; }
  /// Wall time spent in tracing kernels, and in drawing surfaces [ns].
  double traceNs() const { return trace_ns_; }
  double surfaceNs() const { return surface_ns_; }

 private:
  void launch(const SimulationSettings& settings, std::uint32_t seed, std::uint64_t rays);

  Device& device_;
  ProgramCache& cache_;
  int lanes_;
  std::unique_ptr<SurfaceMaker> surface_;
  double surface_correlation_texels_ = 0;  // of surface_, which outlives settings without heights
  SimulationSettings settings_;
  Kernel trace_;
  Buffer run_, outcomes_;
  std::vector<std::uint32_t> words_;
  double trace_ns_ = 0, surface_ns_ = 0;
};

inline constexpr std::uint64_t kRaysPerSurface = std::uint64_t{1} << 20;

/// Surfaces that so many rays are cast at, the last of them perhaps by fewer than the others.
constexpr std::uint64_t surfaceCount(std::uint64_t rays) {
  return (rays + kRaysPerSurface - 1) / kRaysPerSurface;
}

/// Options of heightfield.cl, or of smith_walk.cl, for a simulation.
std::string traceOptions(const SimulationSettings& settings, int lanes);

}  // namespace glintmark
