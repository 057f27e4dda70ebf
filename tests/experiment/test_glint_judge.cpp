// Methods of glints against a truth that is placed and one that is drawn.
#include "host/experiment/accuracy/glint_judge.h"

#include <gtest/gtest.h>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr int kSide = 16, kLanes = 8;
constexpr std::size_t kStage = 3;  // square pixels, ten reflecting microdetails

struct Bench {
  Device device;
  ProgramCache cache{device};
  GlintJudge judge(double most_details = GlintJudge::kMostDetails) {
    return {device, cache, kLanes, kSide, [](const std::string&) {}, most_details};
  }
};

TEST(GlintJudge, PlacedAndDrawnTruthsAgree) {
  Bench bench;
  GlintJudge placing = bench.judge(), drawing = bench.judge(1);
  const GlintFigures placed = placing.truthForm("binomial", kStage);
  const GlintFigures drawn = drawing.truthForm("binomial", kStage);
  for (const GlintFigures& one : {placed, drawn}) {
    EXPECT_LT(one.error, 2.5 * one.noise);
    EXPECT_NEAR(one.mean.mean(), 1, 0.01);
    EXPECT_NEAR(one.variance_ratio.mean(), 1, 0.2);
    EXPECT_NEAR(one.motion_ratio.mean(), 1, 0.1);
    EXPECT_NEAR(one.zoom_ratio.mean(), 1, 0.1);
    EXPECT_NEAR(one.correlation.mean(), 0, 0.03);
    EXPECT_GT(one.variance_ratio.standardError(), 0);
  }
  EXPECT_TRUE(placed.lobes_error && placed.tent_error);
  EXPECT_FALSE(drawn.lobes_error || drawn.tent_error);
  EXPECT_THROW(drawing.truthForm("lobes", kStage), Error);
  EXPECT_THROW(placing.truthForm("cone", kStage), Error);
}

TEST(GlintJudge, FormsOfTheTruthDifferAsTheyShould) {
  Bench bench;
  GlintJudge judge = bench.judge();
  const GlintFigures lobes = judge.truthForm("lobes", kStage);
  EXPECT_NEAR(lobes.variance_ratio.mean(), 0.5, 0.06);
  EXPECT_EQ(lobes.lobes_error, 0);
  EXPECT_GT(lobes.error, 3 * lobes.noise);
  const GlintFigures tent = judge.truthForm("tent", kStage);
  EXPECT_NEAR(tent.variance_ratio.mean(), 4.0 / 9, 0.06);
  EXPECT_NEAR(tent.correlation.mean(), 0.25, 0.06);
  EXPECT_EQ(tent.tent_error, 0);
}

// Where few microdetails reflect, those that are placed stay over a zoom; those of grids do not.
TEST(GlintJudge, PlacedGlintsStayOverAnOctave) {
  Bench bench;
  GlintJudge judge = bench.judge();
  KernelConfig config;
  config.width = kLanes;
  config.size_variation = false;
  config.method = GlintMethod::kDistributed;
  constexpr std::size_t kFew = 0;  // square pixels, a tenth of a reflecting microdetail
  const GlintFigures placed = judge.method(config, kFew, false);
  EXPECT_NEAR(placed.octave_correlation.mean(), 0.5, 0.06);
  EXPECT_NEAR(placed.zoom_ratio.mean(), 1, 0.25);
  config.method = GlintMethod::kZk16;
  EXPECT_GT(judge.method(config, 1, false).octave_correlation.mean(), 0.1);
}

TEST(GlintJudge, WhatShowsNoGlintsIsFarFromTheTruth) {
  Bench bench;
  GlintJudge judge = bench.judge();
  KernelConfig config;
  config.width = kLanes;
  config.size_variation = false;
  const GlintFigures glints = judge.method(config, kStage, false);
  EXPECT_TRUE(glints.sane);
  EXPECT_FALSE(glints.tent_error);
  EXPECT_GT(glints.error, 5 * glints.noise);
  config.binomial = BinomialForm::kExpected;
  const GlintFigures smooth = judge.method(config, kStage, false);
  // The mean distance of a Poisson number of mean ten from ten, over ten.
  EXPECT_NEAR(smooth.error, 0.25, 0.03);
  EXPECT_LT(smooth.variance_ratio.mean(), 0.001);
  EXPECT_LT(smooth.motion_ratio.mean(), 0.02);
}

}  // namespace
}  // namespace glintmark
