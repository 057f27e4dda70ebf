// What `accuracy glints` prints of kinds of pixels, and the kinds themselves.
#include "host/experiment/accuracy/glint_stage_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "host/core/error.h"
#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

std::vector<Record> stageRecords(const std::string& setting, double value) {
  std::vector<Record> records;
  for (const GlintStage& stage : glintStages())
    for (const char* metric :
         {"error", "truth_stderr", "lobes_error", "tent_error", "bias", "variance_ratio",
          "dark_share", "truth_dark_share", "largest_of_bound", "correlation", "motion_ratio",
          "zoom_ratio", "octave_correlation", "error_swing", "variance_swing", "dark_swing",
          "largest_swing", "correlation_swing"}) {
      // Of lambda, so that a mean over aspects is told from one over lambdas.
      records.push_back(
          sampleRecord(glintStageCase("glints/" + setting, stage), metric, value * stage.lambda));
      records.back().table = "accuracy";
    }
  return records;
}

TEST(GlintStageTable, FitsTheColumnsWhateverTheValues) {
  for (const double value : {1e-12, 0.0123456, -0.5, 98765.4321, 3e9, double{INFINITY}}) {
    std::vector<Record> records = stageRecords("method=a_method_of_a_long_name", value);
    const std::vector<Record> more = stageRecords("truth=lobes", value);
    records.insert(records.end(), more.begin(), more.end());
    std::istringstream lines(glintStageText(records));
    for (std::string one; std::getline(lines, one);) EXPECT_LE(one.size(), 100u) << one;
  }
}

TEST(GlintStageTable, LinesAreMeansOverTheirKindsOfPixels) {
  const std::string text = glintStageText(stageRecords("method=some", 0.01));
  // By lambda the value itself; by aspect the geometric mean over lambdas.
  EXPECT_NE(text.find("some    n=0.1 0.0010"), std::string::npos) << text;
  const double over_lambdas = 0.01 * std::pow(0.1 * 0.5 * 2 * 10 * 100 * 1000, 1.0 / 6);
  EXPECT_NEAR(over_lambdas, 0.0681, 1e-4);
  EXPECT_NE(text.find("1:16 0.0681"), std::string::npos) << text;
  EXPECT_NE(text.find("near 0.0002"), std::string::npos) << text;
  EXPECT_EQ(glintStageText({}), "");
}

TEST(GlintStageTable, CasesNameTheirPixels) {
  const std::vector<GlintStage> stages = glintStages();
  for (std::size_t i = 0; i < stages.size(); ++i)
    EXPECT_EQ(glintStageOf(glintStageCase("glints/method=zk16", stages[i])), i);
  EXPECT_EQ(glintStageCase("glints/method=zk16", {4, 0.5}),
            "glints/method=zk16/aspect=4/lambda=0.5");
  EXPECT_THROW(glintStageOf("glints/method=zk16/aspect=3/lambda=2"), Error);
}

// What replicates and steps of a zoom share, and what not.
TEST(GlintStageTable, ReplicatesMoveAndTheZoomKeepsTheNumber) {
  const GlintStage stage{4, 10};
  for (int step = 0; step < kGlintZoomSteps; ++step) {
    const PixelLattice lattice = glintLattice(stage, 3, step, 16);
    const double details = lattice.area() * double{glintMaterial(stage, step).glints.density};
    EXPECT_NEAR(details * glintLight(stage).probability, stage.lambda, 1e-4);
    EXPECT_NEAR(glm::length(lattice.edge_x) / glm::length(lattice.edge_y), stage.aspect, 1e-9);
  }
  EXPECT_NEAR(glintLattice(stage, 0, 8, 16).area() / glintLattice(stage, 0, 0, 16).area(), 2, 1e-9);
  EXPECT_NE(glintLattice(stage, 0, 0, 16).centre_uv, glintLattice(stage, 1, 0, 16).centre_uv);
  EXPECT_EQ(glintLattice(stage, 1, 5, 16).centre_uv, glintLattice(stage, 1, 0, 16).centre_uv);
}

TEST(GlintStageTable, StandardErrorsComeFromTheReplicates) {
  const ReplicatedFigure figure{{1, 2, 3, 4, 5, 6, 7, 8}, 0};
  EXPECT_NEAR(figure.mean(), 4.5, 1e-12);
  EXPECT_NEAR(figure.standardError(), std::sqrt(6.0 / 8), 1e-12);
}

}  // namespace
}  // namespace glintmark
