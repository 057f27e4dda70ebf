// The truth of glints against what is known of it in closed form, and its two forms against each
// other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/core/error.h"
#include "host/harness/pixel_harness.h"
#include "host/microdetail/binomial_truth.h"
#include "host/microdetail/glint_statistics.h"
#include "host/microdetail/method_ratios.h"
#include "host/microdetail/microdetail_truth.h"
#include "host/ocl/switches.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

const glm::dvec2 kHalfSlope = {0.12, 0.09};

MicrodetailSurface surfaceOf(float2 alpha_g, float2 alpha_l, double density) {
  MicrodetailSurface surface;
  surface.material = simpleMaterial(alpha_g, alpha_l, static_cast<float>(density));
  return surface;
}

LightSlopes lightOn(const MicrodetailSurface& surface) {
  const MaterialParams& m = surface.material;
  return pointSlopes(kHalfSlope, {m.surface.alpha_g.x, m.surface.alpha_g.y},
                     {m.glints.alpha_l.x, m.glints.alpha_l.y});
}

MicrodetailRatios placed(const PixelLattice& lattice, const MicrodetailSurface& surface,
                         const LightSlopes& light, PixelFilter filter = PixelFilter::kBox,
                         int lanes = 8) {
  KernelBench& bench = testBench();
  return MicrodetailTruth(bench.device, bench.cache, lanes).place(lattice, surface, light, filter);
}

constexpr double kPixelArea = 1e-6;  // uv squared
// A surface whose pixels of kPixelArea have `details` microdetails.
MicrodetailSurface surfaceOfCount(double details, float alpha_l = 0.06f) {
  return surfaceOf({0.3f, 0.2f}, {alpha_l, alpha_l}, details / kPixelArea);
}
PixelLattice latticeOf(double aspect, int side = 64) {
  return tiledLattice({3.1, -2.7}, kPixelArea, aspect, 0.4, side, side);
}

TEST(Microdetails, MeanAndVarianceOfBothForms) {
  for (const double aspect : {1.0, 16.0}) {
    for (const double details : {3.0, 30.0, 3000.0, 2e6}) {
      const MicrodetailSurface surface = surfaceOfCount(details);
      const LightSlopes light = lightOn(surface);
      const int side = details > 1e4 ? 4 : details > 1000 ? 24 : 128;
      const MicrodetailRatios ratios = placed(latticeOf(aspect, side), surface, light);
      const double lambda = details * light.probability;
      const double pixels = side * side;
      const GlintStatistics lobes = glintStatistics(redOf(ratios.lobes), side);
      const GlintStatistics reflecting = glintStatistics(redOf(ratios.reflecting), side);
      // Poisson: k varies by lambda, k / lambda by one over it.
      const double error = std::sqrt(1 / lambda / pixels);
      EXPECT_NEAR(reflecting.mean, 1, 4 * error) << aspect << " " << details;
      EXPECT_NEAR(lobes.mean, 1, 4 * error) << aspect << " " << details;
      EXPECT_NEAR(reflecting.variance * lambda, 1, 4 * std::sqrt((2 + 1 / lambda) / pixels))
          << aspect << " " << details;
      // Of lobes, by the mean square of a microdetail's share over its mean:
      // D_l^2 is a lobe of alpha_l^2 / 2, convolved with D_m.
      double mean_square = 1;
      const MaterialParams& m = surface.material;
      const double l_sq = m.glints.alpha_l.x * m.glints.alpha_l.x;
      for (const auto& [alpha, slope] :
           {std::pair{m.surface.alpha_g.x, kHalfSlope.x}, {m.surface.alpha_g.y, kHalfSlope.y}}) {
        const double wide_sq = alpha * alpha - l_sq / 2;
        mean_square *= std::sqrt(l_sq / 2 / wide_sq) * std::exp(-slope * slope / wide_sq);
      }
      EXPECT_NEAR(lobes.variance * details * light.probability * light.probability / mean_square, 1,
                  6 * std::sqrt((2 + 1 / lambda) / pixels))
          << aspect << " " << details;
      // Pixels that lie edge to edge share no microdetail.
      EXPECT_NEAR(reflecting.correlation, 0, 4 / std::sqrt(pixels));
    }
  }
}

// Shares of pixels with k = 0, 1, ... up to `most`, the rest in the last.
std::vector<double> shares(const std::vector<float>& ratios, double lambda, std::size_t most) {
  std::vector<double> found(most + 1, 0.0);
  for (const float ratio : ratios) {
    const double k = std::round(ratio * lambda);
    EXPECT_NEAR(ratio * lambda, k, 1e-3);
    found[std::min(static_cast<std::size_t>(k), most)] += 1 / static_cast<double>(ratios.size());
  }
  return found;
}

TEST(Microdetails, PlacedAndDrawnNumbersHaveOneDistribution) {
  constexpr int kSide = 128;
  constexpr double kPixels = kSide * kSide;
  for (const CountLaw law : {CountLaw::kPoisson, CountLaw::kFixed}) {
    for (const double details : {20.0, 250.0}) {
      MicrodetailSurface surface = surfaceOfCount(details);
      surface.law = law;
      const LightSlopes light = lightOn(surface);
      const double lambda = details * light.probability;
      const auto most = static_cast<std::size_t>(lambda + 3 * std::sqrt(lambda) + 1);
      const auto placed_shares =
          shares(redOf(placed(latticeOf(1, kSide), surface, light).reflecting), lambda, most);
      const auto drawn_shares = shares(
          binomialFrames(std::size_t{kSide} * kSide, details, light.probability, 0.75, law, 7)
              .still,
          lambda, most);
      // Each share differs by the errors of two samples.
      for (std::size_t k = 0; k <= most; ++k) {
        const double share = 0.5 * (placed_shares[k] + drawn_shares[k]);
        EXPECT_NEAR(placed_shares[k], drawn_shares[k],
                    4 * std::sqrt(2 * share * (1 - share) / kPixels) + 2 / kPixels)
            << details << " " << k;
      }
    }
  }
}

TEST(Microdetails, FixedCountsAreBinomialWhereEveryDetailReflects) {
  // As rough as the surface: each microdetail mirrors D_g(h) / D_g(0) of the light, all of it here.
  MicrodetailSurface surface = surfaceOf({0.3f, 0.3f}, {0.3f, 0.3f}, 4000 / kPixelArea);
  const LightSlopes light = pointSlopes({0, 0}, {0.3, 0.3}, {0.3, 0.3});
  ASSERT_NEAR(light.probability, 1, 1e-9);
  const double poisson =
      glintStatistics(redOf(placed(latticeOf(1, 24), surface, light).reflecting), 24).variance;
  surface.law = CountLaw::kFixed;
  const double fixed =
      glintStatistics(redOf(placed(latticeOf(1, 24), surface, light).reflecting), 24).variance;
  EXPECT_NEAR(poisson * 4000, 1, 0.25);
  EXPECT_LT(fixed, poisson / 10);  // only cells that an edge cuts vary
}

TEST(Microdetails, AQuarterOfAPixelKeepsThreeQuarters) {
  constexpr int kSide = 96;
  const MicrodetailSurface surface = surfaceOfCount(400);
  const LightSlopes light = lightOn(surface);
  const PixelLattice lattice = latticeOf(4, kSide);
  for (const PixelFilter filter : {PixelFilter::kBox, PixelFilter::kTent}) {
    const auto here = redOf(placed(lattice, surface, light, filter).reflecting);
    const auto there =
        redOf(placed(lattice.moved(kGlintMotion_px, 0), surface, light, filter).reflecting);
    double product = 0;
    for (std::size_t i = 0; i < here.size(); ++i)
      product += (here[i] - 1.0) * (there[i] - 1.0) / static_cast<double>(here.size());
    const GlintStatistics still = glintStatistics(here, kSide, there);
    // Of a box 1 - d; of a tent, by its own correlation, 1 - 1.5 d^2 + 0.75 d^3.
    const double d = kGlintMotion_px;
    const bool tent = filter == PixelFilter::kTent;
    EXPECT_NEAR(product / still.variance, tent ? 1 - 1.5 * d * d + 0.75 * d * d * d : 1 - d, 0.03);
    // A tent's mean square is 2 / 3 along either edge; a pixel further it still shares 1 / 4.
    const double lambda = 400 * light.probability;
    EXPECT_NEAR(still.mean, 1, 0.02);
    EXPECT_NEAR(still.variance * lambda, tent ? 4.0 / 9 : 1.0, 0.06);
    EXPECT_NEAR(still.correlation, tent ? 0.25 : 0.0, 0.05);
    if (tent) continue;
    // Numbers that are drawn change as those of placed microdetails do.
    const BinomialFrames drawn =
        binomialFrames(here.size(), 400, light.probability, 1 - d, CountLaw::kPoisson, 3);
    EXPECT_NEAR(glintStatistics(drawn.still, kSide, drawn.moved).change, still.change,
                0.05 * still.change);
  }
}

// A pixel in eight by eight parts: what lies in it lies in one of them.
TEST(Microdetails, APixelIsTheSumOfItsParts) {
  for (const double aspect : {1.0, 16.0}) {
    // From cells larger than a part to thousands of cells a pixel.
    for (const double details : {200.0, 200000.0}) {
      const MicrodetailSurface surface = surfaceOfCount(details);
      const LightSlopes light = lightOn(surface);
      const PixelLattice whole = latticeOf(aspect, 4);
      PixelLattice parts = whole;
      parts.step_x = parts.edge_x = whole.edge_x / 8.0;
      parts.step_y = parts.edge_y = whole.edge_y / 8.0;
      parts.centre_uv -= 3.5 * (parts.step_x + parts.step_y);
      parts.columns = parts.rows = 32;
      const auto large = redOf(placed(whole, surface, light).reflecting);
      const auto small = redOf(placed(parts, surface, light).reflecting);
      const double lambda = details * light.probability;
      for (std::size_t i = 0; i < large.size(); ++i) {
        double sum = 0;
        for (std::size_t part = 0; part < 64; ++part)
          sum += small[(8 * (i / 4) + part / 8) * 32 + 8 * (i % 4) + part % 8] / 64;
        // Rounding may move one in a thousand across an edge.
        EXPECT_NEAR(sum * lambda, large[i] * lambda, 0.1 + 1e-3 * lambda) << aspect << " " << i;
      }
    }
  }
}

TEST(Microdetails, LanesAndPlacesOnTheTextureChangeNothing) {
  const MicrodetailSurface surface = surfaceOfCount(100);
  const LightSlopes light = lightOn(surface);
  const auto one = placed(latticeOf(4, 16), surface, light, PixelFilter::kBox, 1);
  for (const int lanes : {4, 8, 16}) {
    const auto more = placed(latticeOf(4, 16), surface, light, PixelFilter::kBox, lanes);
    for (std::size_t i = 0; i < one.lobes.size(); ++i) {
      EXPECT_NEAR(one.lobes[i].r, more.lobes[i].r, 1e-4 * (1 + one.lobes[i].r)) << lanes;
      EXPECT_NEAR(one.reflecting[i].r, more.reflecting[i].r, 1e-4 * (1 + one.reflecting[i].r));
    }
  }
  // A pixel is the same whatever lattice it belongs to: seen alone, far from the first.
  const PixelLattice lattice = latticeOf(4, 16);
  PixelLattice last = lattice.moved(15, 15);
  last.columns = last.rows = 1;
  EXPECT_NEAR(placed(last, surface, light).lobes[0].r, one.lobes.back().r, 1e-4);
  // Another seed is another surface.
  MicrodetailSurface other = surface;
  other.seed = 2;
  EXPECT_NE(redOf(placed(lattice, other, light).lobes), redOf(one.lobes));
}

TEST(Microdetails, PixelsSmallerThanAMicrodetailSeeAtMostAFew) {
  // A hundredth of a microdetail under a pixel, p = 1/4: no microdetail is brighter than 1 / p.
  const MicrodetailSurface surface = surfaceOf({0.3f, 0.3f}, {0.15f, 0.15f}, 0.01 / kPixelArea);
  const LightSlopes light = pointSlopes({0, 0}, {0.3, 0.3}, {0.15, 0.15});
  const auto ratios = redOf(placed(latticeOf(1, 128), surface, light).reflecting);
  const GlintStatistics seen = glintStatistics(ratios, 128);
  EXPECT_NEAR(seen.mean, 1, 0.4);                  // some 160 microdetails in all
  EXPECT_LE(seen.largest * light.probability, 6);  // so many overlap
  EXPECT_GT(seen.correlation, 0.7);                // a microdetail spans ten pixels
}

TEST(Microdetails, ConesOfLight) {
  const MicrodetailSurface surface = surfaceOf({0.3f, 0.3f}, {0.06f, 0.06f}, 300 / kPixelArea);
  const glm::dvec3 view = glm::normalize(glm::dvec3(0.3, 0.1, 1));
  for (const double half_angle_deg : {0.5, 5.0, 15.0}) {
    const reference::Cone cone{glm::normalize(glm::dvec3(-0.1, 0.2, 1)),
                               half_angle_deg * std::numbers::pi / 180};
    const LightSlopes light = coneSlopes(cone, view, {0.3, 0.3}, {0.06, 0.06}, 256);
    // The project's brute force over the same cone.
    const double p = reference::coneProbability(cone, view, {0.3, 0.3}, {0.06, 0.06}, false, 20000);
    EXPECT_NEAR(light.probability / p, 1, 0.01) << half_angle_deg;
    constexpr int kSide = 48;
    const MicrodetailRatios ratios = placed(latticeOf(1, kSide), surface, light);
    const double error = std::sqrt(1 / (300 * p) / (kSide * kSide));
    EXPECT_NEAR(glintStatistics(redOf(ratios.lobes), kSide).mean, 1, 4 * error);
    const GlintStatistics reflecting = glintStatistics(redOf(ratios.reflecting), kSide);
    EXPECT_NEAR(reflecting.mean, 1, 4 * error);
    EXPECT_NEAR(reflecting.variance * 300 * p, 1, 0.15);
  }
}

// What zk16 and exact have to share with the truth: the smooth lobe that both are relative to.
TEST(Microdetails, MethodsHaveTheTruthsMean) {
  KernelBench& bench = testBench();
  const MicrodetailSurface surface = surfaceOfCount(2000);
  std::vector<PixelLattice> lattices(4);
  double at = 0;
  for (PixelLattice& lattice : lattices) {
    lattice = tiledLattice({100.3 * at, 7.7 - at}, kPixelArea, 4, 0.7 * at, 32, 24);
    ++at;
  }
  for (const GlintMethod method : {GlintMethod::kZk16, GlintMethod::kExact}) {
    KernelConfig config;
    config.width = 8;
    config.method = method;
    config.size_variation = false;
    const auto ratios =
        methodRatios(bench.device, bench.cache, config, lattices, surface.material, kHalfSlope);
    ASSERT_EQ(ratios.size(), 4u);
    std::vector<float> all;
    for (const auto& lattice : ratios) {
      ASSERT_EQ(lattice.size(), 32u * 24);
      for (const glm::vec3& ratio : lattice) all.push_back(ratio.r);
    }
    // Neighbours share cells: some hundred independent ones at least.
    EXPECT_NEAR(glintStatistics(all, 32).mean, 1, 0.05) << choiceName(method);
    // Far apart, nothing is repeated.
    EXPECT_NE(redOf(ratios[0]), redOf(ratios[1]));
  }
}

TEST(Microdetails, StatisticsOfHandMadePixels) {
  // Three columns: neighbours (0, 4), (4, 0.005), (2, 2), (2, 1.995), and down (0, 2), (4, 2),
  // (0.005, 1.995).
  const std::vector<float> still = {0, 4, 0.005f, 2, 2, 1.995f};
  std::vector<float> moved = still;
  moved[1] = 1;
  const GlintStatistics s = glintStatistics(still, 3, moved);
  const double mean = 10.0 / 6;
  EXPECT_NEAR(s.mean, mean, 1e-6);
  double variance = 0, product = 0;
  for (const float value : still) variance += (value - mean) * (value - mean) / 6;
  for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {3, 4}, {4, 5}, {0, 3}, {1, 4}, {2, 5}})
    product += (still[static_cast<std::size_t>(a)] - mean) *
               (still[static_cast<std::size_t>(b)] - mean) / 7;
  EXPECT_NEAR(s.variance, variance, 1e-6);
  EXPECT_NEAR(s.correlation, product / variance, 1e-6);
  EXPECT_NEAR(s.dark, 2.0 / 6, 1e-9);
  EXPECT_EQ(s.largest, 4);
  EXPECT_NEAR(s.change, 0.5, 1e-6);
  EXPECT_THROW(glintStatistics(still, 4), Error);
  EXPECT_THROW(glintStatistics({}, 1), Error);
  EXPECT_THROW(glintStatistics(still, 3, std::vector<float>{1}), Error);
}

TEST(Microdetails, WhatCannotBePlacedIsSaid) {
  EXPECT_THROW(detailCounts(0, CountLaw::kPoisson), Error);
  EXPECT_THROW(detailCounts(1e20, CountLaw::kPoisson), Error);
  EXPECT_THROW(binomialFrames(1, 0, 0.5, 0.75, CountLaw::kFixed, 1), Error);
  EXPECT_THROW(binomialFrames(1, 10, 1.5, 0.75, CountLaw::kFixed, 1), Error);
  EXPECT_THROW(binomialFrames(1, 10, 0.5, 1.5, CountLaw::kFixed, 1), Error);
  const reference::Cone below{{0, 0, -1}, 0.1};
  EXPECT_THROW(coneSlopes(below, {0, 0, 1}, {0.3, 0.3}, {0.1, 0.1}, 16), Error);
}

TEST(Microdetails, SizesAndColours) {
  const DetailSizes sizes = detailSizes(2);
  double mean = 0, mean_square = 0;
  for (const double size : sizes.sizes) {
    mean += size / static_cast<double>(sizes.sizes.size());
    mean_square += size * size / static_cast<double>(sizes.sizes.size());
  }
  EXPECT_NEAR(mean * sizes.number_factor, 1, 1e-5);
  MicrodetailSurface surface = surfaceOfCount(60);
  surface.material.glints.size_variation = 2;
  surface.material.glints.palette[0] = {1, 0, 0, 0};
  surface.material.glints.palette[1] = {1, 1, 0, 0};
  surface.material.glints.palette_count = 2;
  surface.coloured = true;
  const LightSlopes light = lightOn(surface);
  constexpr int kSide = 128;
  const auto ratios = placed(latticeOf(1, kSide), surface, light).reflecting;
  glm::dvec3 sum(0);
  for (const glm::vec3& ratio : ratios) sum += glm::dvec3(ratio) / (1.0 * kSide * kSide);
  const double lambda = 60 * light.probability;
  const double variance = mean_square * sizes.number_factor / lambda;
  const double error = std::sqrt(variance / (kSide * kSide));
  EXPECT_NEAR(sum.r, 1, 4 * error);
  EXPECT_NEAR(sum.g, 0.5, 4 * error);
  EXPECT_EQ(sum.b, 0);
  EXPECT_NEAR(glintStatistics(redOf(ratios), kSide).variance / variance, 1, 0.15);
}

}  // namespace
}  // namespace glintmark
