// Equal time and equal error: curves of sampled rivals, settings beside the default, scenes.
#include "host/experiment/accuracy/equal_cost.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/accuracy/scene_table.h"
#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

// Error 8 / samples, 0.5 of the default's time a sample.
std::vector<SampledPoint> monteCarlo() {
  std::vector<SampledPoint> curve;
  for (const double samples : {1, 4, 16}) curve.push_back({samples, 0.5 * samples, 8 / samples});
  return curve;
}

TEST(EqualCost, CurvesGoOnAsTheyFall) {
  const auto curve = monteCarlo();
  EXPECT_NEAR(errorAtTime(curve, 1).value(), 4, 1e-9);
  EXPECT_NEAR(errorAtTime(curve, 5).value(), 0.8, 1e-9);
  EXPECT_NEAR(errorAtTime(curve, 50).value(), 0.08, 1e-9) << "beyond the last";
  EXPECT_NEAR(timeAtError(curve, 4).value(), 1, 1e-9);
  EXPECT_NEAR(timeAtError(curve, 0.01).value(), 400, 1e-6) << "beyond the last";
  // Half of its samples less, twice the error.
  EXPECT_NEAR(timeAtError(std::vector(curve.begin() + 1, curve.end()), 4).value(), 1, 1e-9);
}

TEST(EqualCost, OneSampleIsTheLeast) {
  const auto curve = monteCarlo();
  EXPECT_FALSE(errorAtTime(curve, 0.25));
  EXPECT_EQ(timeAtError(curve, 20), 0.5) << "one sample is close enough";
}

TEST(EqualCost, WhatDoesNotFallReachesNothing) {
  const std::vector<SampledPoint> level = {{1, 1, 0.5}, {2, 2, 0.5}};
  EXPECT_FALSE(timeAtError(level, 0.1));
  EXPECT_FALSE(errorAtTime(level, 10));
  EXPECT_FALSE(timeAtError(std::vector<SampledPoint>{{1, 1, 0.5}}, 0.1));
  EXPECT_FALSE(errorAtTime({}, 1));
  EXPECT_FALSE(timeAtError(monteCarlo(), 0));
}

void addSetting(std::vector<Record>& records, const std::string& name, const char* role,
                double time_ratio, double error) {
  for (const auto& [metric, value] : {std::pair<const char*, double>{"error", error},
                                      {"truth_stderr", 0.0001},
                                      {"time_ratio", time_ratio},
                                      {"bias", -0.01},
                                      {"rel_mse", error}}) {
    Record record = sampleRecord(name, metric, value);
    record.table = "accuracy";
    record.config["role"] = role;
    record.value.stddev = 0;
    records.push_back(record);
  }
}

std::vector<Record> sweep(const std::string& group, double slow) {
  std::vector<Record> records;
  addSetting(records, group + "/method=exact", kAccuracyDefault, 1, 0.02);
  addSetting(records, group + "/method=fast", kAccuracyKnob, 0.5, 0.04);
  addSetting(records, group + "/method=fine", kAccuracyKnob, 2, 0.005);
  addSetting(records, group + "/method=alike", kAccuracyKnob, 1.02, 0.0201);
  for (const int samples : {1, 4, 16})
    addSetting(records, group + "/mc_samples=" + std::to_string(samples), kAccuracySampled,
               slow * samples, 1.6 / samples);
  return records;
}

double valueOf(const std::vector<Record>& made, const std::string& name, const char* metric) {
  for (const Record& record : made)
    if (record.case_ == name && record.metric == metric) return record.value.median;
  return -1;
}

TEST(EqualCost, SettingsHaveTheTimeAndErrorTheyHave) {
  const std::vector<Record> made = accuracyDerived(sweep("ltc", 0.5));
  const auto at = [&](const char* name, const char* metric) { return valueOf(made, name, metric); };
  EXPECT_EQ(at("ltc/method=exact", "error_at_default_time"), 0.02);
  EXPECT_EQ(at("ltc/method=exact", "time_at_default_error"), 1);
  EXPECT_EQ(at("ltc/method=exact", "efficiency"), 1);
  EXPECT_EQ(at("ltc/method=fast", "error_at_default_time"), 0.04);
  EXPECT_EQ(at("ltc/method=fast", "time_at_default_error"), -1) << "never";
  EXPECT_EQ(at("ltc/method=fast", "efficiency"), 1);
  EXPECT_EQ(at("ltc/method=fine", "error_at_default_time"), -1) << "never";
  EXPECT_EQ(at("ltc/method=fine", "time_at_default_error"), 2);
  EXPECT_EQ(at("ltc/method=fine", "efficiency"), 2);
  // Within a step of the default in both.
  EXPECT_EQ(at("ltc/method=alike", "error_at_default_time"), 0.0201);
  EXPECT_EQ(at("ltc/method=alike", "time_at_default_error"), 1.02);
  // Error 1.6 / samples: 2 samples in the default's time, 80 for its error.
  for (const char* name : {"ltc/mc_samples=1", "ltc/mc_samples=16"}) {
    EXPECT_NEAR(at(name, "error_at_default_time"), 0.8, 1e-9);
    EXPECT_NEAR(at(name, "time_at_default_error"), 40, 1e-6);
    EXPECT_NEAR(at(name, "efficiency"), 0.02 / 0.8, 1e-9);
  }
}

TEST(EqualCost, ScenesAreGroupsOfTheirOwn) {
  std::vector<Record> records = sweep("ltc", 0.5);
  for (const auto& [scene, slow] :
       {std::pair{"ltc/area_cloth/near", 0.5}, std::pair{"ltc/area_knot/middle", 2.0}}) {
    const std::vector<Record> more = sweep(scene, slow);
    records.insert(records.end(), more.begin(), more.end());
  }
  const std::vector<Record> made = accuracyDerived(records);
  EXPECT_EQ(std::ranges::count(made, "pareto", &Record::metric), 7) << "of the effect alone";
  EXPECT_NEAR(valueOf(made, "ltc/area_knot/middle/mc_samples=4", "time_at_default_error"), 160,
              1e-6);
  EXPECT_EQ(accuracyTableText(records), accuracyTableText(sweep("ltc", 0.5)));

  const std::string text = accuracySceneText(records, "ltc");
  EXPECT_NE(text.find("cloth/near  knot/middle"), std::string::npos) << text;
  EXPECT_NE(text.find("method=exact *"), std::string::npos) << text;
  EXPECT_NE(text.find("For the default's error mc_samples takes 40.0 (cloth/near) to 160 "
                      "(knot/middle) times its time."),
            std::string::npos)
      << text;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
  EXPECT_EQ(accuracySceneText(records, "gmm"), "");
}

TEST(EqualCost, WhatIsNotValidHasNone) {
  std::vector<Record> records = sweep("ltc", 0.5);
  for (Record& record : records)
    if (record.case_ == "ltc/method=fine") record.valid = false;
  const std::vector<Record> made = accuracyDerived(records);
  EXPECT_EQ(valueOf(made, "ltc/method=fine", "time_at_default_error"), -1);
  EXPECT_EQ(valueOf(made, "ltc/method=fine", "efficiency"), -1);
}

}  // namespace
}  // namespace glintmark
