// Which of several trade-offs are worth having.
#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace glintmark {

/// What something costs and how wrong it is; less is better in both.
struct CostAndError {
  double cost = 0, error = 0;
};

/// True for every point that no other dominates. A point dominates another if it is no worse in
/// both and better in one; equal points keep each other. A point with a value that is not a number
/// is never optimal and dominates nothing.
std::vector<bool> paretoOptimal(std::span<const CostAndError> points);

/// The neighbours of points[at] among the optimal ones: `up` has the least cost of those that cost
/// more and err less, `down` the greatest cost of those that cost less and err more; nothing where
/// there is none.
struct ParetoSteps {
  std::optional<std::size_t> up, down;
};
ParetoSteps paretoSteps(std::span<const CostAndError> points, std::size_t at);

/// The cheapest point that dominates points[at]; nothing if it is optimal.
std::optional<std::size_t> cheapestDominating(std::span<const CostAndError> points, std::size_t at);

}  // namespace glintmark
