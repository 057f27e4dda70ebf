// Wasserstein distance against closed forms.
#include "host/report/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "host/core/error.h"

namespace glintmark {
namespace {

using Values = std::vector<float>;

TEST(Distribution, EqualOnesAreNotApart) {
  EXPECT_EQ(wassersteinDistance(Values{1, 2, 5}, Values{1, 2, 5}), 0);
  // The same distribution by more samples.
  EXPECT_EQ(wassersteinDistance(Values{1, 2, 5}, Values{1, 1, 2, 2, 5, 5}), 0);
}

TEST(Distribution, AShiftIsItsLength) {
  EXPECT_NEAR(wassersteinDistance(Values{1, 2, 5}, Values{4, 5, 8}), 3, 1e-12);
}

TEST(Distribution, PointsByHand) {
  EXPECT_NEAR(wassersteinDistance(Values{0}, Values{1, 3}), 2, 1e-12);
  // Quantiles 0 0 1 | 0 1 1 over thirds.
  EXPECT_NEAR(wassersteinDistance(Values{0, 0, 1}, Values{0, 1, 1}), 1.0 / 3, 1e-12);
  // Halves against thirds: steps at 1/3, 1/2, 2/3.
  EXPECT_NEAR(wassersteinDistance(Values{0, 6}, Values{0, 3, 6}), 3.0 / 6 + 3.0 / 6, 1e-12);
}

TEST(Distribution, UniformAgainstItsSquare) {
  // W1 between x and x^2 of a uniform x is the integral of x - x^2: 1/6.
  Values x, squares;
  for (int i = 0; i < 10000; ++i) {
    const auto value = static_cast<float>((i + 0.5) / 10000);
    x.push_back(value);
    squares.push_back(value * value);
  }
  EXPECT_NEAR(wassersteinDistance(x, squares), 1.0 / 6, 1e-6);
  EXPECT_NEAR(wassersteinDistance(squares, x), 1.0 / 6, 1e-6);
}

TEST(Distribution, EmptyIsAnError) {
  EXPECT_THROW(wassersteinDistance(Values{}, Values{1}), Error);
  EXPECT_THROW(wassersteinDistance(Values{1}, Values{}), Error);
}

}  // namespace
}  // namespace glintmark
