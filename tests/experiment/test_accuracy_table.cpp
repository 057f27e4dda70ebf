// Table "accuracy": which settings are optimal, and the sentence below it.
#include "host/experiment/accuracy/accuracy_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

void addCase(std::vector<Record>& records, const std::string& name, const std::string& role,
             double time_ratio, double error, double truth_stderr = 0.001) {
  for (const auto& [metric, value] : {std::pair<const char*, double>{"error", error},
                                      {"truth_stderr", truth_stderr},
                                      {"time_ratio", time_ratio},
                                      {"time_ms", 10 * time_ratio}}) {
    Record record = sampleRecord(name, metric, value);
    record.table = "accuracy";
    record.config["role"] = role;
    record.note = "error: made up";
    record.value.stddev = 0;
    records.push_back(record);
  }
}

std::vector<Record> sampleSweep() {
  std::vector<Record> records;
  addCase(records, "glints/ka=1", kAccuracyKnob, 0.25, 0.4);
  addCase(records, "glints/ka=8", kAccuracyKnob, 0.5, 0.1);
  addCase(records, "glints/ka=16", kAccuracyDefault, 1, 0.05);
  addCase(records, "glints/ka=32", kAccuracyKnob, 1.5, 0.02);
  addCase(records, "glints/lanes=1", kAccuracyKnob, 8, 0.05);
  addCase(records, "ltc/method=exact", kAccuracyDefault, 1, 0.3);
  return records;
}

double paretoOf(const std::vector<Record>& made, const std::string& name) {
  for (const Record& record : made)
    if (record.case_ == name && record.metric == "pareto") return record.value.median;
  return -1;
}

TEST(AccuracyTable, ParetoOfEachEffectApart) {
  const std::vector<Record> made = accuracyDerived(sampleSweep());
  EXPECT_EQ(std::ranges::count(made, "pareto", &Record::metric), 6);
  EXPECT_EQ(paretoOf(made, "glints/ka=1"), 1);
  EXPECT_EQ(paretoOf(made, "glints/ka=16"), 1);
  EXPECT_EQ(paretoOf(made, "glints/ka=32"), 1);
  EXPECT_EQ(paretoOf(made, "glints/lanes=1"), 0);
  EXPECT_EQ(paretoOf(made, "ltc/method=exact"), 1);
}

TEST(AccuracyTable, WhatWasNotMeasuredDecidesNothing) {
  std::vector<Record> records;
  addCase(records, "gmm/lobes=4", kAccuracyDefault, 1, 0.0004);
  addCase(records, "gmm/lobes=8", kAccuracyKnob, 1.001, 0.0002);  // below the truth's error
  addCase(records, "gmm/lobes=6", kAccuracyKnob, 2, 0.0001);      // the same, and slower
  const std::vector<Record> made = accuracyDerived(records);
  EXPECT_EQ(paretoOf(made, "gmm/lobes=4"), 1);
  EXPECT_EQ(paretoOf(made, "gmm/lobes=8"), 1);
  EXPECT_EQ(paretoOf(made, "gmm/lobes=6"), 0);
}

TEST(AccuracyTable, LessThanAStepFromTheDefaultIsNoDifference) {
  std::vector<Record> records;
  addCase(records, "ltc/table=64", kAccuracyDefault, 1, 0.0100);
  addCase(records, "ltc/table=32", kAccuracyKnob, 0.96, 0.0104);
  addCase(records, "ltc/table=8", kAccuracyKnob, 0.96, 0.0200);
  addCase(records, "ltc/table=16", kAccuracyKnob, 0.94, 0.0100);
  EXPECT_EQ(paretoOf(accuracyDerived(records), "ltc/table=64"), 0);
  records.resize(records.size() - 4);
  EXPECT_EQ(paretoOf(accuracyDerived(records), "ltc/table=64"), 1);
  EXPECT_EQ(paretoOf(accuracyDerived(records), "ltc/table=32"), 1);
  EXPECT_EQ(paretoOf(accuracyDerived(records), "ltc/table=8"), 0);
}

TEST(AccuracyTable, SaysWhatTheStepsCost) {
  const std::string text = accuracyTableText(sampleSweep());
  std::string line = text;
  std::replace(line.begin(), line.end(), '\n', ' ');
  EXPECT_NE(line.find("The default of glints has an error of 0.05"), std::string::npos) << text;
  EXPECT_NE(line.find("the fastest setting, ka=1, has 0.4 in 25 % of the time"), std::string::npos)
      << text;
  EXPECT_NE(line.find("the next step up, ka=32, takes 1.50 times its time for an error of 0.02"),
            std::string::npos)
      << text;
  EXPECT_NE(line.find("the next step down, ka=8, takes 0.50 times its time for an error of 0.1"),
            std::string::npos)
      << text;
  EXPECT_NE(line.find("The default of ltc has an error of 0.3; no setting that takes longer is "
                      "closer; no optimal setting is faster."),
            std::string::npos)
      << text;
  std::istringstream lines(text);
  for (std::string one; std::getline(lines, one);) EXPECT_LE(one.size(), 100u) << one;
}

TEST(AccuracyTable, ATimeWithinItsSpreadIsNoDifference) {
  std::vector<Record> records;
  addCase(records, "gmm/probes=16", kAccuracyDefault, 1, 0.01);
  addCase(records, "gmm/probes=8", kAccuracyKnob, 0.9, 0.01);
  Record& ratio = records[records.size() - 2];
  ASSERT_EQ(ratio.metric, "time_ratio");
  ratio.value.n = 9;
  ratio.value.stddev = 0.05;  // of the median 0.021, twice 0.042
  EXPECT_EQ(paretoOf(accuracyDerived(records), "gmm/probes=16"), 0);
  ratio.value.stddev = 0.15;  // twice 0.125
  EXPECT_EQ(paretoOf(accuracyDerived(records), "gmm/probes=16"), 1);
}

TEST(AccuracyTable, WhatIsNotValidIsNeverOptimalAndBeatsNothing) {
  std::vector<Record> records = sampleSweep();
  addCase(records, "ltc/edges=acos", kAccuracyKnob, 0.5, 0);
  for (Record& record : records)
    if (record.case_ == "ltc/edges=acos") record.valid = false;
  const std::vector<Record> made = accuracyDerived(records);
  EXPECT_EQ(paretoOf(made, "ltc/edges=acos"), 0);
  EXPECT_EQ(paretoOf(made, "ltc/method=exact"), 1);
}

TEST(AccuracyTable, ABeatenDefaultIsNamed) {
  std::vector<Record> records;
  addCase(records, "ltc/edges=fit", kAccuracyDefault, 1, 0.05);
  addCase(records, "ltc/edges=acos", kAccuracyKnob, 0.8, 0.04);
  const std::string text = accuracyTableText(records);
  EXPECT_NE(text.find("it is beaten: edges=acos"), std::string::npos) << text;
}

TEST(AccuracyTable, NothingMeasuredIsNothing) {
  EXPECT_TRUE(accuracyDerived({}).empty());
  EXPECT_EQ(accuracyTableText({}), "");
}

}  // namespace
}  // namespace glintmark
