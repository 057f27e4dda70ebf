// Grids of samples of directions, for the fits of linearly transformed cosines.
#pragma once
#include <cmath>
#include <glm/glm.hpp>

namespace glintmark {

/// Proposals are this much wider than what they stand for, so that weights stay small beside peaks.
inline constexpr double kWidenProposal = 1.4;

struct GridPoint {
  double share;      // [0, 1)
  double angle_rad;  // [0, turn)
};

/// Point (i, j) of a grid in the unit square, the second axis an angle of `turn_rad` in all. Each
/// column is shifted by its own share of a row, so that no two samples of a round lobe fall on one
/// ring: an absolute difference has a kink wherever it vanishes at a sample, and rings would add up
/// to large ones.
inline GridPoint gridPoint(int i, int j, int rows, int columns, double turn_rad) {
  constexpr double kGolden = 0.6180339887498949;
  const double shift = (j + 0.5) * kGolden;
  return {(i + shift - std::floor(shift)) / rows, turn_rad * (j + 0.5) / columns};
}

/// Of a clamped cosine around z.
inline glm::dvec3 cosineDirection(const GridPoint& p) {
  const double radius = std::sqrt(p.share);
  return {radius * std::cos(p.angle_rad), radius * std::sin(p.angle_rad), std::sqrt(1 - p.share)};
}

/// Of the even hemisphere around z.
inline glm::dvec3 uniformDirection(const GridPoint& p) {
  const double radius = std::sqrt(1 - p.share * p.share);
  return {radius * std::cos(p.angle_rad), radius * std::sin(p.angle_rad), p.share};
}

}  // namespace glintmark
