// The reference of what metals get back, against what its authors promise.
#include <gtest/gtest.h>

#include <cmath>

#include "host/reference/rough_metal.h"
#include "tests/fit/hemisphere_integral.h"

namespace glintmark::reference {
namespace {

glm::dvec3 towards(double mu, double azimuth = 0) {
  const double r = std::sqrt(1 - mu * mu);
  return {r * std::cos(azimuth), r * std::sin(azimuth), mu};
}

TEST(RoughMetal, AWhiteMirrorLosesNothing) {
  for (const double alpha : {0.1, 0.5, 1.0}) {
    const RoughMetal metal(alpha);
    for (const double mu : {0.05, 0.3, 0.9})
      for (const MetalWay way :
           {MetalWay::kTurquin, MetalWay::kMean, MetalWay::kKullaConty, MetalWay::kFdezAguera})
        EXPECT_NEAR(metal.albedo(way, 1, mu), 1, 1e-9) << alpha << " " << mu;
  }
}

// The closed form of the albedo is the integral of the lobe.
TEST(RoughMetal, AlbedosAreIntegrals) {
  const RoughMetal metal(0.6);
  for (const MetalWay way : {MetalWay::kSingle, MetalWay::kTurquin, MetalWay::kMean,
                             MetalWay::kKullaConty, MetalWay::kFdezAguera})
    for (const double mu : {0.2, 0.8}) {
      const double integral = integrateDirections(
          [&](const glm::dvec3& light) {
            return metal.brdfTimesCosine(way, 0.4, light, towards(mu));
          },
          0, 1, 1e-5);
      EXPECT_NEAR(metal.albedo(way, 0.4, mu), integral, 1e-3) << static_cast<int>(way) << " " << mu;
    }
}

TEST(RoughMetal, KullaContyIsReciprocal) {
  const RoughMetal metal(0.7);
  const glm::dvec3 a = towards(0.3), b = towards(0.8, 2);
  EXPECT_NEAR(metal.brdfTimesCosine(MetalWay::kKullaConty, 0.5, a, b) / a.z,
              metal.brdfTimesCosine(MetalWay::kKullaConty, 0.5, b, a) / b.z, 1e-12);
}

// Every further bounce is darker: what colour gives back is less than a white mirror's share.
TEST(RoughMetal, ColoursSaturate) {
  const RoughMetal metal(0.8);
  for (const MetalWay way : {MetalWay::kMean, MetalWay::kKullaConty, MetalWay::kFdezAguera}) {
    const double single = metal.albedo(MetalWay::kSingle, 0.5, 0.5);
    const double given = metal.albedo(way, 0.5, 0.5) - single;
    EXPECT_GT(given, 0);
    EXPECT_LT(given, 0.5 * (1 - metal.mirror(0.5)));
  }
}

}  // namespace
}  // namespace glintmark::reference
