#include "host/report/record/comparison.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

constexpr double kThreshold = 0.05;

Record measured(const std::string& metric, const std::string& unit, std::vector<double> samples) {
  Record record = sampleRecord("snow/steep", metric, 1);
  record.unit = unit;
  record.value = summarize(samples);
  return record;
}

Comparison compareOne(const Record& before, const Record& after,
                      std::span<const TableSpec> tables = {}) {
  const ComparisonReport report =
      compareResults({sampleRun(), {before}}, {sampleRun(), {after}}, tables, kThreshold);
  EXPECT_EQ(report.comparisons.size(), 1u);
  return report.comparisons.at(0);
}

Change changeOf(const std::string& metric, const std::string& unit,
                const std::vector<double>& before, const std::vector<double>& after) {
  return compareOne(measured(metric, unit, before), measured(metric, unit, after)).change;
}

TEST(Comparison, TellsChangeFromNoise) {
  EXPECT_EQ(changeOf("shading_ms", "ms", {10, 10.1, 9.9, 10}, {12, 12.1, 11.9, 12}),
            Change::kWorse);
  EXPECT_EQ(changeOf("shading_ms", "ms", {12, 12.1, 11.9, 12}, {10, 10.1, 9.9, 10}),
            Change::kBetter);
  EXPECT_EQ(changeOf("shading_ms", "ms", {10, 14, 7, 10}, {12, 17, 9, 12}), Change::kNoise);
  EXPECT_EQ(changeOf("shading_ms", "ms", {10, 10.01, 9.99, 10}, {10.2, 10.21, 10.19, 10.2}),
            Change::kSame);  // certain, but below the threshold
}

// The words go where WORSE would stand, and only where a busy machine explains it.
TEST(Comparison, ABusyMachineIsSaidInThePlaceOfWorse) {
  const std::vector<double> low = {10, 10.1, 9.9, 10}, high = {12, 12.1, 11.9, 12};
  const auto compare = [](const Record& before, const Record& after, const RunInfo& old_run,
                          const RunInfo& new_run) {
    return compareResults({old_run, {before}}, {new_run, {after}}, {}, kThreshold);
  };
  RunInfo busy = sampleRun();
  busy.busy = "its FMA peak moved from 200 to 150 GFLOP/s";
  const Record fast = measured("shading_ms", "ms", low), slow = measured("shading_ms", "ms", high);
  for (const auto& [old_run, new_run] :
       {std::pair{sampleRun(), busy}, std::pair{busy, sampleRun()}}) {
    const ComparisonReport report = compare(fast, slow, old_run, new_run);
    EXPECT_EQ(report.comparisons.at(0).change, Change::kBusy);
    EXPECT_FALSE(report.hasRegression());
    EXPECT_NE(comparisonText(report, false).find("run was busy: its FMA peak moved"),
              std::string::npos);
  }
  EXPECT_EQ(compare(slow, fast, sampleRun(), busy).comparisons.at(0).change, Change::kBetter);
  EXPECT_EQ(compare(measured("loop_instructions", "instructions", {100}),
                    measured("loop_instructions", "instructions", {200}), sampleRun(), busy)
                .comparisons.at(0)
                .change,
            Change::kWorse);
  EXPECT_EQ(compare(measured("colour_error", "1", {0.05}), measured("colour_error", "1", {0.06}),
                    sampleRun(), busy)
                .comparisons.at(0)
                .change,
            Change::kWorse);
}

TEST(Comparison, FiguresOfTwoClocksAreCountedAndCompared) {
  Record before = measured("shading_ms", "ms", {10, 10.1, 9.9}), after = before;
  before.timer = "device";
  after.timer = "wall";
  after.config["timer"] = "wall";
  const ComparisonReport report =
      compareResults({sampleRun(), {before}}, {sampleRun(), {after}}, {}, kThreshold);
  EXPECT_EQ(report.comparisons.size(), 1u);
  EXPECT_EQ(report.other_timers, 1u);
  EXPECT_NE(comparisonText(report, false).find("1 figures were timed by another clock"),
            std::string::npos);
}

TEST(Comparison, KnowsWhichWayIsBetter) {
  const std::vector<double> low = {10, 10.1, 9.9}, high = {20, 20.1, 19.9};
  EXPECT_EQ(changeOf("rays_per_s", "rays/s", low, high), Change::kBetter);
  EXPECT_EQ(changeOf("fps", "1/s", high, low), Change::kWorse);
  EXPECT_EQ(changeOf("speedup_vs_w1", "1", low, high), Change::kBetter);
  EXPECT_EQ(changeOf("normalised_cost", "1", low, high), Change::kWorse);
  // Of a ratio only its table knows.
  const TableSpec table = {.name = "zk16", .title = "", .cost_ratios = {"here_over_there"}};
  const Record before = measured("here_over_there", "1", low);
  const Record after = measured("here_over_there", "1", high);
  EXPECT_EQ(compareOne(before, after).change, Change::kDifferent);
  EXPECT_EQ(compareOne(before, after, {&table, 1}).change, Change::kWorse);
  EXPECT_EQ(compareOne(after, before, {&table, 1}).change, Change::kBetter);
  EXPECT_EQ(changeOf("fournier_over_gmm", "1", low, high), Change::kDifferent);
  EXPECT_EQ(changeOf("cells_mean", "cells", low, high), Change::kDifferent);
}

TEST(Comparison, OneSampleSaysNothingAboutATimeButAllAboutACount) {
  EXPECT_EQ(changeOf("build_ms", "ms", {100}, {300}), Change::kUndecided);
  EXPECT_EQ(changeOf("build_ms", "ms", {100}, {100, 300, 500}), Change::kUndecided);
  EXPECT_EQ(changeOf("colour_error", "1", {0.05}, {0.06}), Change::kWorse);
  EXPECT_EQ(changeOf("bias", "1", {-0.05}, {0.06}), Change::kWorse);
  EXPECT_EQ(changeOf("bias", "1", {-0.05}, {0.04}), Change::kBetter);
  EXPECT_EQ(changeOf("colour_error", "1", {0}, {0}), Change::kSame);
  EXPECT_EQ(changeOf("colour_error", "1", {0}, {0.001}), Change::kWorse);
}

// Under the null hypothesis p is uniform for means; for medians of five normal samples the test is
// close enough to it that its level holds.
TEST(Comparison, FalseAlarmsAreRare) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(10, 1);
  constexpr int kPairs = 20000;
  int alarms = 0;
  for (int pair = 0; pair < kPairs; ++pair) {
    std::vector<double> a(9), b(9);
    for (double& sample : a) sample = normal(random);
    for (double& sample : b) sample = normal(random);
    const auto p =
        compareOne(measured("shading_ms", "ms", a), measured("shading_ms", "ms", b)).p_value;
    ASSERT_TRUE(p);
    alarms += *p < kChangeLevel;
  }
  EXPECT_GT(alarms, 0);
  EXPECT_LT(alarms, 2 * kChangeLevel * kPairs);
}

TEST(Comparison, MatchesByConfigurationButNotByBuildOptions) {
  Record before = sampleRecord("snow/steep", "shading_ms", 10), after = before;
  before.config["kernels"] = "-D OLD=1";
  before.config["reps"] = "5";
  after.config["kernels"] = "-D NEW=1";
  Record other_size = after;
  other_size.config["size"] = "64x64";
  const ComparisonReport report =
      compareResults({sampleRun(), {before, sampleRecord("gone", "shading_ms", 1)}},
                     {sampleRun(), {after, other_size}}, {}, kThreshold);
  EXPECT_EQ(report.comparisons.size(), 1u);
  EXPECT_EQ(report.only_old, 1u);
  EXPECT_EQ(report.only_new, 1u);
  EXPECT_FALSE(report.hasRegression());
}

TEST(Comparison, LosingValidityIsARegression) {
  Record before = sampleRecord("snow/steep", "shading_ms", 10), after = before;
  after.valid = false;
  const ComparisonReport report =
      compareResults({sampleRun(), {before}}, {sampleRun(), {after}}, {}, kThreshold);
  EXPECT_TRUE(report.hasRegression());
  EXPECT_NE(comparisonText(report, false).find("zk16 snow/steep shading_ms was valid"),
            std::string::npos);
}

TEST(Comparison, TextShowsChangesOrAll) {
  const Results before{
      sampleRun(),
      {measured("shading_ms", "ms", {10, 10.1, 9.9}), measured("raster_ms", "ms", {5, 5, 5})}};
  const Results after{
      sampleRun(),
      {measured("shading_ms", "ms", {20, 20.1, 19.9}), measured("raster_ms", "ms", {5, 5, 5})}};
  const ComparisonReport report = compareResults(before, after, {}, kThreshold);
  const std::string changes = comparisonText(report, false), all = comparisonText(report, true);
  EXPECT_NE(changes.find("+100.0%"), std::string::npos) << changes;
  EXPECT_NE(changes.find("WORSE"), std::string::npos);
  EXPECT_EQ(changes.find("raster_ms"), std::string::npos);
  EXPECT_NE(all.find("raster_ms"), std::string::npos);
  const auto json = nlohmann::json::parse(comparisonJson(report, kThreshold));
  EXPECT_EQ(json["comparisons"].size(), 2u);
  EXPECT_EQ(json["comparisons"][0]["change"], "WORSE");
  EXPECT_EQ(json["regression"], true);
}

}  // namespace
}  // namespace glintmark
