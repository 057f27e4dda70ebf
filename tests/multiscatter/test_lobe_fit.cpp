// Fits recover what made the data.
#include <gtest/gtest.h>

#include "host/fit/lobe_fit.h"

namespace glintmark {
namespace {

LobeData syntheticData(double alpha, double mu, int order, const FreeLobe& lobe) {
  LobeData data;
  data.alpha = alpha;
  data.mu_in = mu;
  data.order = order;
  for (int row = 0; row < LobeData::kCosines; ++row)
    for (int column = 0; column < LobeData::kAzimuths; ++column) {
      data.energy.push_back(
          freeLobeEnergy(lobe, alpha, mu, LobeData::cosine(row), LobeData::azimuth(column)));
      data.share +=
          data.energy.back() * 2 * std::numbers::pi / (LobeData::kCosines * LobeData::kAzimuths);
    }
  return data;
}

TEST(LobeFit, RecoversAFreeLobe) {
  const FreeLobe truth{0.3, 1.4, 0.7, -0.2, 0, 0};
  const FreeLobe fitted = fitLobe(syntheticData(0.6, 0.5, 2, truth));
  EXPECT_LT(fitted.error, 1e-3);
  EXPECT_NEAR(fitted.deviation_rad, truth.deviation_rad, 0.02);
}

// All five parameters of [PAT18] leave a mark: the fit finds each of them.
TEST(LobeFit, RecoversEachOfTheFiveParameters) {
  const FreeLobe truth{0.4, 1.2, 0.8, -0.15, 0.7, 0};
  const LobeData data = syntheticData(0.9, 0.35, 2, truth);
  const FreeLobe fitted = fitLobe(data);
  EXPECT_LT(fitted.error, 1e-3);
  EXPECT_NEAR(fitted.exponent, truth.exponent, 0.1);
  EXPECT_NEAR(fitted.flattening, truth.flattening, 0.05);
  EXPECT_NEAR(fitted.deviation_rad, truth.deviation_rad, 0.02);
  EXPECT_NEAR(fitted.masking, truth.masking, 0.1);
  const FreeLobe unmasked = fitLobe(data, false);
  EXPECT_EQ(unmasked.masking, 0);
  EXPECT_GT(unmasked.error, 2 * fitted.error);
}

TEST(LobeFit, RoughnessOfALobeIsThePapers) {
  EXPECT_EQ((FreeLobe{1, 0, 1, 0, 0, 0}.roughness()), 1);
  EXPECT_NEAR((FreeLobe{1, 1023, 1, 0, 0, 0}.roughness()), 0, 1e-12);
}

TEST(LobeFit, EmptyDataGiveAnEmptyLobe) {
  const FreeLobe nothing{0, 1, 1, 0, 0, 0};
  EXPECT_EQ(fitLobe(syntheticData(0.1, 1, 4, nothing)).scale, 0);
}

TEST(LobeFit, PolynomialsThatMadeTheDataFitThem) {
  std::vector<LobeData> data;
  for (const double alpha : {0.2, 0.4, 0.6, 0.8, 1.0})
    for (const double mu : {0.1, 0.4, 0.7, 1.0})
      for (const int order : {2, 3}) {
        const Lobe lobe = lobeAt(kPublishedCode, mu, alpha);
        const double scale = lobe.scale * (order == 3 ? kPublishedCode.third_order : 1);
        data.push_back(
            syntheticData(alpha, mu, order, {scale, lobe.exponent, lobe.flattening, 0, 0, 0}));
      }
  const LobePolynomials fitted = fitPolynomials(data);
  for (const LobeData& one : data) {
    if (one.order != 2) continue;
    const Lobe lobe = lobeAt(fitted, one.mu_in, one.alpha);
    EXPECT_LT(lobeError(one,
                        [&](double cosine, double) {
                          return lobeEnergy(lobe.scale, lobe.exponent, lobe.flattening, cosine);
                        }),
              0.01);
  }
  for (const double alpha : {0.2, 0.6, 1.0})
    EXPECT_NEAR(fitted.thirdOverSecond(alpha), kPublishedCode.third_order, 1e-3);
}

TEST(LobeFit, EonsRoughnessIsFoundAgain) {
  const EonRoughness truth{0.6, 0.4};
  std::vector<LobeData> totals;
  for (const double alpha : {0.2, 0.5, 1.0})
    for (const double mu : {0.3, 0.9}) {
      LobeData data;
      data.alpha = alpha;
      data.mu_in = mu;
      for (int row = 0; row < LobeData::kCosines; ++row)
        for (int column = 0; column < LobeData::kAzimuths; ++column)
          data.energy.push_back(
              eonEnergy(truth.at(alpha), mu, LobeData::cosine(row), LobeData::azimuth(column)));
      data.share = 1;
      totals.push_back(std::move(data));
    }
  const EonRoughness fitted = fitEonRoughness(totals);
  EXPECT_NEAR(fitted.top, truth.top, 1e-3);
  EXPECT_NEAR(fitted.knee, truth.knee, 1e-3);
}

}  // namespace
}  // namespace glintmark
