// The analytic models in double precision: energy, sign, limits.
#include <gtest/gtest.h>

#include <cmath>

#include "host/core/angles.h"
#include "host/fit/lobe_fit.h"
#include "host/fit/lobe_model.h"
#include "host/fit/multiscatter_data.h"
#include "host/reference/microfacet.h"
#include "host/simulate/simulation.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

// Midpoint quadrature of smooth lobes with 200 cosines.
constexpr double kQuadrature = 1e-3;

// Energy of a beam of cosine mu that leaves over the hemisphere.
double lobeFurnace(const LobeModel& model, double albedo, double mu) {
  constexpr int kSteps = 200;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    sum += 2 * t * model.energy(albedo, mu, t * t);
  }
  return 2 * kPi * sum / kSteps;
}

TEST(LobeModels, NeverNegativeNeverMoreThanCameIn) {
  for (const LobePolynomials* p : {&kPublishedCode, &kPublishedText, &multiscatterData().refit})
    for (const double masking : {0.0, 0.6})
      for (double alpha = 0; alpha <= 1; alpha += 0.08) {
        LobePolynomials set = *p;
        set.masking = masking;
        const LobeModel model(set, alpha);
        for (const double mu : {0.0, 1e-6, 0.1, 0.5, 1.0})
          for (const double albedo : {0.0, 0.5, 1.0}) {
            const double energy = lobeFurnace(model, albedo, mu);
            EXPECT_TRUE(std::isfinite(energy));
            EXPECT_GE(energy, 0);
            EXPECT_LE(energy, albedo + kQuadrature) << alpha << " " << mu;
            EXPECT_GE(model.energy(albedo, mu, 0), 0);
          }
      }
}

// Light from everywhere must not come back brighter; the lobes alone would do so.
TEST(LobeModels, AWhiteFurnaceStaysWhiteOrDarker) {
  for (const LobePolynomials* p : {&kPublishedCode, &kPublishedText, &multiscatterData().refit})
    for (const double alpha : {0.08, 0.24, 0.5, 1.0}) {
      const LobeModel model(*p, alpha);
      for (const double mu_out : {0.001, 0.02, 0.2, 0.6, 1.0}) {
        constexpr int kSteps = 400;
        double radiance = 0;
        for (int i = 0; i < kSteps; ++i) {
          const double mu = (i + 0.5) / kSteps;
          radiance += 2 * kPi * mu * model.energy(1, mu, mu_out) / mu_out / kSteps;
        }
        EXPECT_LE(radiance, 1 + kQuadrature) << alpha << " " << mu_out;
      }
    }
}

TEST(LobeModels, MaskingIsAFactorOfTheLobes) {
  EXPECT_EQ(maskingFactor(0, 0.7, 0.3, 0.4), 1);
  EXPECT_EQ(smithMasking(0.5, 0), 1);
  EXPECT_EQ(smithMasking(1, 0.8), 1);
  EXPECT_EQ(smithMasking(0, 0.8), 0);
  // 1 / (1 + Lambda) of the exact Lambda; the fit is good to 0.35 %.
  for (const double mu : {0.05, 0.2, 0.5, 0.9}) {
    const glm::dvec3 w(std::sqrt(1 - mu * mu), 0, mu);
    const double exact = 1 / (1 + reference::microfacetLambda(reference::Ndf::kBeckmann, w, 0.6));
    EXPECT_NEAR(smithMasking(mu, 0.6), exact, 0.004) << mu;
  }
  EXPECT_NEAR(maskingFactor(0.25, 0.6, 0.3, 0.7),
              0.75 + 0.25 * smithMasking(0.3, 0.6) * smithMasking(0.7, 0.6), 1e-12);
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

TEST(Eon, FittedRoughnessIsCloserToTheSimulationThanAlphaItself) {
  auto& [device, cache] = testBench();
  Simulator simulator(device, cache, device.info().default_lanes);
  for (const double alpha : {0.24, 0.62, 1.0}) {
    double fitted = 0, alpha_itself = 0;
    for (const double incidence_deg : {20.0, 60.0, 80.0}) {
      SimulationSettings settings;
      settings.alpha = glm::dvec2(alpha);
      settings.incidence_deg = incidence_deg;
      settings.rays = 1 << 19;
      settings.seed = 77;  // not among the fit's
      const LobeData data = makeLobeData(simulator.run(settings), 0);
      const auto error = [&data](double r) {
        return lobeError(data, [&](double cosine, double azimuth) {
          return eonEnergy(r, data.mu_in, cosine, azimuth);
        });
      };
      fitted += error(multiscatterData().eon.at(alpha));
      alpha_itself += error(alpha);
    }
    EXPECT_LT(fitted, 0.7 * alpha_itself) << alpha;
  }
}

TEST(Eon, RoughnessRisesFromZero) {
  const EonRoughness& eon = multiscatterData().eon;
  EXPECT_EQ(eon.at(0), 0);
  for (double alpha = 0.05; alpha <= 1; alpha += 0.05) {
    EXPECT_GT(eon.at(alpha), eon.at(alpha - 0.05));
    EXPECT_LE(eon.at(alpha), 1);
  }
}

TEST(MirrorTable, LosesMoreTheRougher) {
  const MirrorAlbedo& table = multiscatterData().mirror;
  for (const std::vector<double>* energy : {&table.simulated, &table.lobe}) {
    EXPECT_GT(table.at(*energy, 0, 1), 0.995);
    EXPECT_LT(table.at(*energy, 1, 1), table.at(*energy, 0.5, 1));
    EXPECT_NEAR(table.at(*energy, table.alphas[3], table.warped[5]),
                (*energy)[3 * table.warped.size() + 5], 1e-12);
    EXPECT_TRUE(std::isfinite(table.at(*energy, 0, 0)));
  }
}

TEST(MirrorTable, WarpedCosinesComeBack) {
  for (const double alpha : {0.01, 0.3, 1.0})
    for (const double mu : {0.0, 0.003, 0.2, 0.9, 1.0})
      EXPECT_NEAR(MirrorAlbedo::cosine(alpha, MirrorAlbedo::warp(alpha, mu)), mu, 1e-12);
}

// Real surfaces shadow less than Smith's independent heights, most on the roughest.
TEST(MirrorTable, SimulationAndLobeAreAlike) {
  const MirrorAlbedo& table = multiscatterData().mirror;
  for (std::size_t i = 0; i < table.lobe.size(); ++i) {
    const double t = table.warped[i % table.warped.size()];
    if (t < 0.2) continue;
    EXPECT_NEAR(table.simulated[i], table.lobe[i], 0.05)
        << table.alphas[i / table.warped.size()] << " " << t;
  }
}

}  // namespace
}  // namespace glintmark
