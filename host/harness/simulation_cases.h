// Surfaces whose rays have a known fate.
#pragma once
#include "host/simulate/simulation.h"

namespace glintmark {

/// A mirror whose Fresnel term is 1.
inline SimulationSettings mirror(double alpha, double incidence_deg, std::uint64_t rays) {
  SimulationSettings s;
  s.kind = SurfaceKind::kMetal;
  s.index_n = 0.05;
  s.index_k = 1000;
  s.alpha = glm::dvec2(alpha);
  s.incidence_deg = incidence_deg;
  s.rays = rays;
  return s;
}

}  // namespace glintmark
