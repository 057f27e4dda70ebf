// Masking, and the published model against its own code. The models over dense grids are checked by
// host/verify/scatter_checks.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/fit/lobe_model.h"
#include "host/harness/scatter_harness.h"
#include "host/harness/tolerances.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

/// Below this cosine of the view mu^(eta - 1) no longer grows in the kernels.
constexpr double kLeastComparedCosine = 0.02;

TEST(Masking, OfNoImportanceChangesNoBit) {
  const std::vector<DirectionPair> pairs = denseDirections();
  const Material material = roughMaterial(DiffuseModel::kRefit, 0.7, 0.8);
  const auto without = probeScatter(testBench(), pairs, material, 16),
             with = probeScatter(testBench(), pairs, material, 16, true);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    ASSERT_EQ(without[i].single, with[i].single);
    ASSERT_EQ(without[i].multiple, with[i].multiple);
  }
}

TEST(Masking, DarkensGrazingLobes) {
  const std::vector<DirectionPair> grazing = {{directionAt(0.1, 0), directionAt(0.1, 2)}};
  const auto multiple = [&](double masking) {
    return probeScatter(testBench(), grazing, roughMaterial(DiffuseModel::kRefit, 1, 1, masking),
                        16)[0]
        .multiple;
  };
  const double g = smithMasking(0.1, 1);
  // [PAT18] "Analytical Lobe Expression"; nothing is cut off here.
  EXPECT_NEAR(multiple(0.5) / multiple(0), 0.5 + 0.5 * g * g, 2e-3);
  EXPECT_NEAR(multiple(1) / multiple(0), g * g, 2e-3);
}

// [PAT18] "Example Code", written anew from the blog with its own digits: the lobe's intensity,
// which is 2 pi times the energy per solid angle.
double patapomIntensity(double mu, double mu_out, double r, double albedo) {
  const double scale =
      0.028813261153483097 - 0.9215374811620882 * r + 6.632726114385572 * std::pow(r, 2) -
      4.5957022306534 * std::pow(r, 3) +
      mu * (-0.09663259042197028 + 7.214143602200921 * r - 19.786845117100626 * std::pow(r, 2) +
            11.042058883797509 * std::pow(r, 3)) +
      std::pow(mu, 2) * (0.10935692546815767 - 10.790405157520944 * r +
                         28.50803667636733 * std::pow(r, 2) - 15.665258273262731 * std::pow(r, 3)) +
      std::pow(mu, 3) * (-0.04376425480146207 + 5.2491960091879 * r -
                         13.582707339717146 * std::pow(r, 2) + 7.348408854602616 * std::pow(r, 3));
  const double eta = 2.588380909161985 * r - 1.3549594389004276 * r * r;
  const double flat =
      0.8850557867448499 - 1.2109761138443194 * r + 0.22569832413951335 * r * r +
      0.4498256199595464 * r * r * r + mu * (0.0856807009397115 + 0.5659031384072539 * r) +
      mu * mu * (-0.07707463071513312 - 1.384614678037336 * r + 0.8565888280926491 * r * r) +
      mu * mu * mu * (0.010423083821992304 + 0.8525591060832015 * r - 0.6844738691665317 * r * r);
  const double l = 1 / std::sqrt(1 + mu_out * mu_out * (1 / (flat * flat) - 1));
  const double intensity = (eta + 2) * std::pow(mu_out, eta) / kPi;
  return l * intensity * albedo * albedo * (scale + albedo * 0.363902052363025 * scale);
}

TEST(PublishedModel, IsTheBlogsCodeWhereThatIsNotNegativeAndTheFurnaceHasRoom) {
  const std::vector<DirectionPair> pairs = denseDirections();
  int compared = 0;
  for (const double alpha : {0.08, 0.24, 0.5, 0.8, 1.0})
    for (const double albedo : {0.5, 1.0}) {
      const Material material = roughMaterial(DiffuseModel::kPublished, alpha, albedo);
      const LobeModel model(kPublishedCode, alpha);
      const std::vector<ScatteredRadiance> probed = probeScatter(testBench(), pairs, material, 16);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double in = pairs[i].light.z, out = pairs[i].view.z;
        if (out < kLeastComparedCosine) continue;
        const double blog = patapomIntensity(in, out, alpha, albedo);
        const double expected = std::max(blog, 0.0) / (2 * kPi * out) * in;
        EXPECT_LE(probed[i].multiple, expected * (1 + kScatterTolerance) + 1e-6);
        const double eta = lobeAt(kPublishedCode, 1, alpha).exponent;
        const double furnace = model.means(out).plain * std::pow(out, eta - 1);
        if (furnace > 0.99 * model.scattered()) continue;
        EXPECT_NEAR(probed[i].multiple, expected, kScatterTolerance * expected + 1e-6)
            << alpha << " " << in << " " << out;
        ++compared;
      }
    }
  EXPECT_GT(compared, 2000);
}

TEST(PublishedModel, TextAndCodeHaveTheSameScale) {
  // The digits that the blog's text prints.
  const double text[4][4] = {{0.02881326115, -0.92153748116, 6.63272611438, -4.595702230},
                             {-0.09663259042, 7.21414360220, -19.7868451171, 11.04205888},
                             {0.10935692546, -10.7904051575, 28.5080366763, -15.66525827},
                             {-0.04376425480, 5.24919600918, -13.5827073397, 7.348408854}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_NEAR(kPublishedCode.scale[i][j], text[i][j], 1e-8) << i << " " << j;
}

}  // namespace
}  // namespace glintmark
