// Trade-offs: closed cases, and against the definition by brute force.
#include "host/experiment/accuracy/pareto.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace glintmark {
namespace {

using Points = std::vector<CostAndError>;

TEST(Pareto, NothingAndOnePoint) {
  EXPECT_TRUE(paretoOptimal(Points{}).empty());
  EXPECT_EQ(paretoOptimal(Points{{1, 1}}), std::vector<bool>{true});
}

TEST(Pareto, AFrontAndWhatLiesBehindIt) {
  const Points points = {{1, 8}, {2, 4}, {4, 2}, {8, 1}, {2, 5}, {9, 1}, {5, 5}};
  EXPECT_EQ(paretoOptimal(points),
            (std::vector<bool>{true, true, true, true, false, false, false}));
}

TEST(Pareto, EqualPointsKeepEachOther) {
  EXPECT_EQ(paretoOptimal(Points{{1, 1}, {1, 1}, {1, 2}, {2, 1}}),
            (std::vector<bool>{true, true, false, false}));
}

TEST(Pareto, NoNumberIsNeverOptimal) {
  const double nan = std::nan("");
  EXPECT_EQ(paretoOptimal(Points{{nan, 0}, {0, nan}, {3, 3}}),
            (std::vector<bool>{false, false, true}));
}

TEST(Pareto, StepsAreTheNearestOptimalOnes) {
  const Points points = {{1, 8}, {2, 4}, {4, 2}, {8, 1}, {3, 5}};
  const ParetoSteps middle = paretoSteps(points, 2);
  EXPECT_EQ(middle.up, 3u);
  EXPECT_EQ(middle.down, 1u);
  EXPECT_FALSE(paretoSteps(points, 3).up);
  EXPECT_FALSE(paretoSteps(points, 0).down);
  // From a point that is beaten: both lead to the front.
  const ParetoSteps beaten = paretoSteps(points, 4);
  EXPECT_EQ(beaten.up, 2u);
  EXPECT_FALSE(beaten.down && points[*beaten.down].error <= 5);
}

TEST(Pareto, CheapestThatDominates) {
  const Points points = {{1, 8}, {2, 4}, {2.5, 3}, {3, 5}};
  EXPECT_EQ(cheapestDominating(points, 3), 1u);
  EXPECT_FALSE(cheapestDominating(points, 1));
}

TEST(Pareto, MatchesTheFrontOfASortedSweep) {
  std::mt19937 random(3);
  std::uniform_int_distribution<int> value(0, 30);  // ties are common
  for (int round = 0; round < 200; ++round) {
    Points points;
    for (int i = 0; i < 25; ++i)
      points.push_back({static_cast<double>(value(random)), static_cast<double>(value(random))});
    const std::vector<bool> optimal = paretoOptimal(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      // The least error of all that cost no more, and of all that cost less.
      double least = INFINITY, least_below = INFINITY;
      for (const CostAndError& other : points) {
        if (other.cost <= points[i].cost) least = std::min(least, other.error);
        if (other.cost < points[i].cost) least_below = std::min(least_below, other.error);
      }
      EXPECT_EQ(optimal[i], points[i].error == least && points[i].error < least_below);
    }
  }
}

}  // namespace
}  // namespace glintmark
