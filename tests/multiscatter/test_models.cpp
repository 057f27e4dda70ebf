// The analytic models in double precision: energy, sign, limits.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "host/fit/lobe_model.h"
#include "host/fit/multiscatter_data.h"

namespace glintmark {
namespace {

constexpr double kPi = std::numbers::pi;
// Midpoint quadrature of smooth lobes with 200 cosines.
constexpr double kQuadrature = 1e-3;

double lobeFurnace(const LobePolynomials& p, double alpha, double albedo, double mu) {
  constexpr int kSteps = 200;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    sum += 2 * t * lobeModelEnergy(p, alpha, albedo, mu, t * t);
  }
  return 2 * kPi * sum / kSteps;
}

TEST(LobeModels, NeverNegativeNeverMoreThanCameIn) {
  for (const LobePolynomials* p : {&kPublishedCode, &kPublishedText, &multiscatterData().refit})
    for (double alpha = 0; alpha <= 1; alpha += 0.08)
      for (const double mu : {0.0, 1e-6, 0.1, 0.5, 1.0})
        for (const double albedo : {0.0, 0.5, 1.0}) {
          const double energy = lobeFurnace(*p, alpha, albedo, mu);
          EXPECT_TRUE(std::isfinite(energy));
          EXPECT_GE(energy, 0);
          EXPECT_LE(energy, 1 + kQuadrature) << alpha << " " << mu;
          if (albedo == 1) {
            EXPECT_NEAR(energy, 1, kQuadrature);
          }
          EXPECT_GE(lobeModelEnergy(*p, alpha, albedo, mu, 0), 0);
        }
}

// [PAT18]'s code: order 2 at normal incidence carries 10.8, 16.7, 19.8 and 21.5 %.
TEST(LobeModels, PublishedSharesAreThoseOfItsCode) {
  const double expected[][2] = {{0.24, 0.108}, {0.43, 0.167}, {0.62, 0.198}, {1.0, 0.215}};
  for (const auto& [alpha, share] : expected)
    EXPECT_NEAR(lobeShare(lobeAt(kPublishedCode, 1, alpha)), share, 0.006) << alpha;
}

TEST(Eon, AlbedoIsTheIntegralOfItsBrdf) {
  constexpr int kSteps = 200;
  for (const double r : {0.0, 0.3, 1.0})
    for (const double mu : {0.05, 0.4, 0.95}) {
      double single = 0, all = 0;
      const glm::dvec3 in(std::sqrt(1 - mu * mu), 0, mu);
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double z = (i + 0.5) / kSteps, s = std::sqrt(1 - z * z);
          const double phi = 2 * kPi * (j + 0.5) / kSteps;
          const EonValue v = eonBrdf(in, {s * std::cos(phi), s * std::sin(phi), z}, r, 1);
          single += v.single * z;
          all += (v.single + v.multiple) * z;
        }
      const double scale = 2 * kPi / (kSteps * kSteps);
      EXPECT_NEAR(single * scale, eonAlbedo(mu, r), kQuadrature) << r << " " << mu;
      EXPECT_NEAR(all * scale, 1, kQuadrature) << r << " " << mu;
    }
}

TEST(MirrorTable, LosesMoreTheRougher) {
  const MirrorAlbedo& table = multiscatterData().mirror;
  EXPECT_GT(table.at(0, 1), 0.995);
  EXPECT_LT(table.at(1, 1), table.at(0.5, 1));
  EXPECT_NEAR(table.at(table.alphas[3], table.mus[5]), table.energy[3 * table.mus.size() + 5],
              1e-12);
  EXPECT_TRUE(std::isfinite(table.at(0, 0)));
}

}  // namespace
}  // namespace glintmark
