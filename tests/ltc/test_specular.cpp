// Transformed cosines over polygon lights against the BRDF itself; the kernels are checked against
// the transformed cosines by host/verify.
#include <gtest/gtest.h>

#include <cmath>

#include "host/fit/ltc_lobe.h"
#include "host/harness/specular_cases.h"
#include "host/reference/polygon_light.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

// The published tables are off by as much at grazing angles, where a cosine lobe lacks the BRDF's
// tail.
constexpr double kFitTolerance = 0.06;

TEST(Specular, LobeIsTheBrdfWithinTheFit) {
  const AreaLight light = specularQuad();
  const std::vector<SpecularCase> cases = specularCases(96, light, 0.05);
  const std::vector<glm::vec3> values = shadeSpecular(testBench(), light, cases, 16);
  double sum = 0;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const SpecularCase& c = cases[i];
    const double cosine = glm::dot(c.point.view, c.point.normal);
    const glm::dvec3 view{std::sqrt(1 - cosine * cosine), 0, cosine};
    const glm::dmat3 inverse =
        ltcInverseMatrix(lookUpLtc(shippedGgx(), c.point.alpha, cosine), c.point.alpha, cosine);
    const double exact = std::abs(reference::microfacetOverPolygon(
        reference::Ndf::kGgx, view, c.point.alpha, 1, inverse, c.local));
    EXPECT_NEAR(values[i].x, exact, kFitTolerance)
        << "alpha " << c.point.alpha << " cosine " << cosine;
    sum += std::abs(values[i].x - exact);
  }
  EXPECT_LT(sum / static_cast<double>(cases.size()), kFitTolerance / 5);
}

}  // namespace
}  // namespace glintmark
