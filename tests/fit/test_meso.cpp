// The meso scale on the host: mean lengths, convolution, and the constants the kernels use.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "host/core/error.h"
#include "host/fit/meso_convolution.h"
#include "host/fit/meso_fit.h"
#include "host/reference/scaled_cosine.h"
#include "tests/fit/hemisphere_integral.h"

namespace glintmark {
namespace {

// The shipped constants are rounded to single precision, and libraries differ in the last bits of
// the functions that the fit calls.
constexpr double kConstantsTolerance = 1e-5;
// What the form of the fit leaves, see kernels/area/meso_table.h.
constexpr double kJoinMaxError = 0.0045, kJoinSquares = 0.002, kInverseError = 6e-4;

TEST(MeanResultantLength, AgreesWithQuadrature) {
  for (const double alpha : {0.03, 0.2, 0.7, 0.97, 0.9999, 1.0}) {
    const auto mean_z = [&](double z) {
      return 2 * std::numbers::pi * z * reference::scaledCosineDensity(alpha, z);
    };
    EXPECT_NEAR(reference::meanResultantLength(alpha),
                Quadrature::integrate(mean_z, 0.0, 1.0, 15, 1e-12), 1e-10)
        << alpha;
  }
}

TEST(MeanResultantLength, EndsAndInverse) {
  EXPECT_EQ(reference::meanResultantLength(0), 1);
  EXPECT_NEAR(reference::meanResultantLength(1), 2.0 / 3, 1e-14);
  for (const double alpha : {1e-4, 0.01, 0.3, 0.95, 1.0}) {
    EXPECT_NEAR(reference::alphaOfMeanLength(reference::meanResultantLength(alpha)), alpha,
                1e-6 * alpha);
  }
}

TEST(MesoAlpha, InvertsTheMeanLength) {
  EXPECT_LT(mesoInverseError(shippedMesoConstants()), kInverseError);
}

TEST(MesoAlpha, GuardedOutsideItsRange) {
  const MesoConstants constants = shippedMesoConstants();
  for (const double length : {1.0, 1.0 + 1e-6, 1.7}) EXPECT_EQ(mesoAlpha(constants, length), 0);
  for (const double length : {2.0 / 3, 0.3, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_NEAR(mesoAlpha(constants, length), 1, kInverseError) << length;
  }
  double before = 1;
  for (int i = 0; i <= 10000; ++i) {
    const double alpha = mesoAlpha(constants, 0.6 + 0.4 * i / 10000);
    EXPECT_LE(alpha, before + 1e-12);
    EXPECT_GE(alpha, 0);
    before = alpha;
  }
}

TEST(Tao21, ClampedWhereThePolynomialsLeaveTheirRange) {
  // Both are stated in docs/ltc_fit.md; without clamps Eq. 5 is negative here and Eq. 7 is 1.18.
  EXPECT_EQ(reference::tao21MesoAlpha(0.9999), 0);
  EXPECT_EQ(reference::tao21OverallAlpha(1, 1), 1);
  EXPECT_NEAR(reference::tao21MesoAlpha(reference::meanResultantLength(0.5)), 0.5, 0.005);
  EXPECT_EQ(reference::tao21MesoAlpha(0.1), 1);
}

// Convolution by definition: [TAO21] Eq. 6, over the quantiles of the outer lobe.
double convolvedByDefinition(double outer, double inner, double angle_rad) {
  const glm::dvec3 m(std::sin(angle_rad), 0, std::cos(angle_rad));
  const auto over_share = [&](double share) {
    const double c = std::sqrt((1 - share) / (1 - share + outer * outer * share));
    const double s = std::sqrt(1 - c * c);
    const auto over_turn = [&](double turn) {
      const glm::dvec3 b(s * std::cos(turn), s * std::sin(turn), c);
      return reference::scaledCosineDensity(inner, glm::dot(b, m)) / std::numbers::pi;
    };
    return Quadrature::integrate(over_turn, 0.0, std::numbers::pi, kQuadratureDepth, 1e-8);
  };
  return Quadrature::integrate(over_share, 0.0, 1.0, kQuadratureDepth, 1e-8);
}

TEST(MesoConvolution, SeriesAgreesWithDefinition) {
  const MesoConvolution convolution({0.2, 0.6});
  for (const double angle : {0.0, 0.3, 1.0, 2.0}) {
    const double expected = convolvedByDefinition(0.2, 0.6, angle);
    EXPECT_NEAR(convolution.density(0, 1, angle), expected, 1e-4 * (expected + 0.01)) << angle;
    EXPECT_NEAR(convolution.density(1, 0, angle), expected, 1e-4 * (expected + 0.01)) << angle;
  }
}

TEST(MesoConvolution, RefusesLobesItCannotResolve) {
  EXPECT_THROW(MesoConvolution({0.01}), Error);
  EXPECT_THROW(computeMesoGrid(40), Error);
}

TEST(OverallAlpha, IdentityWithoutTheOtherScale) {
  const MesoConstants constants = shippedMesoConstants();
  for (const double alpha : {0.0, 1e-6, 0.03, 0.5, 1.0}) {
    EXPECT_EQ(overallAlpha(constants, alpha, 0), alpha);
    EXPECT_EQ(overallAlpha(constants, 0, alpha), alpha);
  }
}

TEST(OverallAlpha, MonotoneSymmetricAndBounded) {
  const MesoConstants constants = shippedMesoConstants();
  constexpr int kSteps = 200;
  for (int i = 0; i <= kSteps; ++i) {
    double before = 0;
    for (int j = 0; j <= kSteps; ++j) {
      const double a = 1.0 * i / kSteps, b = 1.0 * j / kSteps;
      const double alpha = overallAlpha(constants, a, b);
      EXPECT_EQ(alpha, overallAlpha(constants, b, a));
      EXPECT_LE(alpha, 1);
      EXPECT_GE(alpha, std::max(a, b));
      EXPECT_LE(alpha, a + b + 1e-12);
      EXPECT_GE(alpha, before);
      before = alpha;
    }
  }
}

// Derives the shipped constants again and holds them to what the header says of them.
TEST(MesoConstants, AreWhatTheFitGives) {
  const MesoGrid grid = computeMesoGrid(32);
  const MesoConstants fitted = fitMeso(grid), shipped = shippedMesoConstants();
  for (std::size_t i = 0; i < fitted.inverse.size(); ++i) {
    EXPECT_NEAR(shipped.inverse[i], fitted.inverse[i],
                kConstantsTolerance * std::abs(fitted.inverse[i]));
  }
  const MesoErrors errors =
      mesoErrors(grid, [&](double mi, double me) { return overallAlpha(shipped, mi, me); });
  const MesoErrors best =
      mesoErrors(grid, [&](double mi, double me) { return overallAlpha(fitted, mi, me); });
  EXPECT_LT(errors.max, kJoinMaxError);
  EXPECT_LT(errors.sum_of_squares, kJoinSquares);
  EXPECT_LT(errors.sum_of_squares, 1.01 * best.sum_of_squares);
  const MesoErrors tao21 = mesoErrors(grid, reference::tao21OverallAlpha);
  EXPECT_GT(tao21.sum_of_squares, 50 * errors.sum_of_squares);
}

}  // namespace
}  // namespace glintmark
