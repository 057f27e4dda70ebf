// Coloured metals, simulated facet by facet, and what the ways to give their lobe its energy back
// make of them.
#pragma once
#include <array>
#include <optional>
#include <span>
#include <string>

#include "host/fit/lobe_fit.h"
#include "host/reference/rough_metal.h"
#include "host/scene/scene.h"
#include "host/simulate/simulation.h"

namespace glintmark {

/// A metal at red, green and blue: by its complex index, or by f0 and a tint at 82 degrees.
struct Conductor {
  const char* name;
  glm::dvec3 n, k;
  std::optional<glm::dvec3> f0;
  double tint = 1;

  /// What the kernels take for its reflectance straight on.
  double reflectance(int channel) const;
};
/// Copper, gold and aluminium; copper's f0 with Schlick's term, as the kernels have it; one whose
/// reflectance dips.
std::span<const Conductor> conductors();

/// Of light that comes from one direction, and by reciprocity of what an eye there sees.
SimulationSettings metalSettings(const Conductor& metal, int channel, SurfaceModel model,
                                 double alpha, double incidence_deg, std::uint64_t rays);

/// The ways at one roughness, in double precision.
class MetalModels {
 public:
  explicit MetalModels(double alpha);
  /// Share of the light that is reflected.
  double albedo(Compensation way, double f0, double mu) const;
  /// Root mean square difference of the lobe, a mean over each cell, over the simulation's mean.
  double lobeError(Compensation way, double f0, const LobeData& data) const;

 private:
  const reference::RoughMetal& metal(Compensation way) const;

  reference::RoughMetal lobe_, simulated_;
};

}  // namespace glintmark
