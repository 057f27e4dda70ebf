#include "host/experiment/accuracy/pareto.h"

#include <algorithm>
#include <cmath>

namespace glintmark {
namespace {

bool isNumber(const CostAndError& point) {
  return !std::isnan(point.cost) && !std::isnan(point.error);
}

// Comparisons with NaN are false, so such a point dominates nothing.
bool dominates(const CostAndError& a, const CostAndError& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

}  // namespace

std::vector<bool> paretoOptimal(std::span<const CostAndError> points) {
  std::vector<bool> optimal;
  for (const CostAndError& point : points)
    optimal.push_back(isNumber(point) &&
                      std::ranges::none_of(points, [&](const CostAndError& other) {
                        return dominates(other, point);
                      }));
  return optimal;
}

ParetoSteps paretoSteps(std::span<const CostAndError> points, std::size_t at) {
  const std::vector<bool> optimal = paretoOptimal(points);
  const CostAndError& from = points[at];
  ParetoSteps steps;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!optimal[i]) continue;
    const CostAndError& to = points[i];
    if (to.cost > from.cost && to.error < from.error &&
        (!steps.up || to.cost < points[*steps.up].cost))
      steps.up = i;
    if (to.cost < from.cost && to.error > from.error &&
        (!steps.down || to.cost > points[*steps.down].cost))
      steps.down = i;
  }
  return steps;
}

std::optional<std::size_t> cheapestDominating(std::span<const CostAndError> points,
                                              std::size_t at) {
  std::optional<std::size_t> cheapest;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (dominates(points[i], points[at]) && (!cheapest || points[i].cost < points[*cheapest].cost))
      cheapest = i;
  return cheapest;
}

}  // namespace glintmark
