// The double-precision microfacet BRDFs against what any must satisfy.
#include <gtest/gtest.h>

#include "host/reference/beckmann.h"
#include "host/reference/microfacet.h"
#include "tests/fit/hemisphere_integral.h"
#include "tests/print_names.h"

namespace glintmark {
namespace {

using reference::Ndf;

// Boost's rule is asked for 1e-7; the sum over rings of what each leaves is below this.
constexpr double kQuadratureError = 1e-5;

glm::dvec3 direction(double theta_rad, double turn_rad = 0) {
  return {std::sin(theta_rad) * std::cos(turn_rad), std::sin(theta_rad) * std::sin(turn_rad),
          std::cos(theta_rad)};
}

class MicrofacetTest : public testing::TestWithParam<std::tuple<Ndf, double>> {
 protected:
  Ndf ndf() const { return std::get<0>(GetParam()); }
  double alpha() const { return std::get<1>(GetParam()); }
};

TEST_P(MicrofacetTest, DensityProjectsToOne) {
  const double total = integrateDirections(
      [&](const glm::dvec3& m) { return reference::microfacetDensity(ndf(), m, alpha()) * m.z; });
  EXPECT_NEAR(total, 1, kQuadratureError);
}

// Smith's masking is the one that keeps the projected area of what is visible: [Heitz14] Eq. 14.
TEST_P(MicrofacetTest, VisibleAreaIsProjectedArea) {
  for (const double theta : {0.2, 0.9, 1.4}) {
    const glm::dvec3 o = direction(theta);
    const double masking = 1 / (1 + reference::microfacetLambda(ndf(), o, alpha()));
    const double visible = integrateDirections([&](const glm::dvec3& m) {
      return masking * std::max(0.0, glm::dot(o, m)) *
             reference::microfacetDensity(ndf(), m, alpha());
    });
    EXPECT_NEAR(visible, o.z, kQuadratureError) << "theta " << theta;
  }
}

TEST_P(MicrofacetTest, Reciprocal) {
  const glm::dvec3 i = direction(0.4, 2.5), o = direction(1.1);
  EXPECT_NEAR(reference::microfacetTimesCosine(ndf(), i, o, alpha()) / i.z,
              reference::microfacetTimesCosine(ndf(), o, i, alpha()) / o.z,
              1e-12 * reference::microfacetTimesCosine(ndf(), i, o, alpha()));
}

TEST_P(MicrofacetTest, FiniteAndContinuousToGrazingViews) {
  const glm::dvec3 i = direction(1.5, std::numbers::pi);
  const double at_horizon = reference::microfacetTimesCosine(ndf(), i, {1, 0, 0}, alpha());
  const double near_it =
      reference::microfacetTimesCosine(ndf(), i, direction(std::acos(1e-9)), alpha());
  EXPECT_TRUE(std::isfinite(at_horizon));
  EXPECT_GT(at_horizon, 0);
  EXPECT_NEAR(near_it / at_horizon, 1, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Roughness, MicrofacetTest,
                         testing::Combine(testing::Values(Ndf::kGgx, Ndf::kBeckmann),
                                          testing::Values(0.1, 0.4, 1.0)));

// Written twice, for slopes and for directions: both must say the same.
TEST(Microfacet, BeckmannAgreesWithTheAnisotropicReference) {
  const glm::dvec3 i = direction(0.7, 2.0), o = direction(1.2);
  for (const double alpha : {0.05, 0.3, 0.9}) {
    const double expected = reference::brdfTimesCosine(i, o, glm::dvec2(alpha), glm::dvec3(1.0)).x;
    EXPECT_NEAR(reference::microfacetTimesCosine(Ndf::kBeckmann, i, o, alpha), expected,
                1e-9 * expected);
  }
}

TEST(Microfacet, NothingBelowTheHorizon) {
  EXPECT_EQ(reference::microfacetTimesCosine(Ndf::kGgx, {0, 0, -1}, {0, 0, 1}, 0.3), 0);
  EXPECT_EQ(reference::microfacetTimesCosine(Ndf::kGgx, {0, 0, 1}, {0, 0, -1}, 0.3), 0);
}

}  // namespace
}  // namespace glintmark
