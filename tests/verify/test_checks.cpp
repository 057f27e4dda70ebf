// Every check of `glintmark verify`, at one lane and at the device's own count; those that compare
// lanes at all counts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <ostream>
#include <set>

#include "host/core/error.h"
#include "host/verify/check.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

constexpr int kDeviceLanes = 0;

struct CheckCase {
  Check check;
  int lanes;  // kDeviceLanes: as the device prefers
};

void PrintTo(const CheckCase& c, std::ostream* out) {
  *out << c.check.name;
}

std::vector<CheckCase> allCases() {
  std::vector<CheckCase> cases;
  for (const Check& check : allChecks()) {
    const bool compares_lanes = check.name.find("same_bits") != std::string::npos;
    if (compares_lanes)
      cases.insert(cases.end(), {{check, 4}, {check, 8}});
    else
      cases.push_back({check, 1});
    cases.push_back({check, kDeviceLanes});
  }
  return cases;
}

std::string nameOf(const testing::TestParamInfo<CheckCase>& info) {
  std::string name = info.param.check.name;
  std::ranges::replace_if(
      name, [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name + (info.param.lanes == kDeviceLanes ? "_device_lanes"
                                                  : "_lanes_" + std::to_string(info.param.lanes));
}

class Checks : public testing::TestWithParam<CheckCase> {};

TEST_P(Checks, Pass) {
  const auto& [check, chosen_lanes] = GetParam();
  const int lanes =
      chosen_lanes == kDeviceLanes ? testBench().device.info().default_lanes : chosen_lanes;
  const CheckResult result = runCheck(check, {testBench(), lanes});
  if (result.verdict == Verdict::kSkipped) GTEST_SKIP() << result.note;
  EXPECT_EQ(result.verdict, Verdict::kPass)
      << check.measure << ": " << result.worst << ", bound " << result.bound << "; " << result.note;
}

INSTANTIATE_TEST_SUITE_P(All, Checks, testing::ValuesIn(allCases()), nameOf);

TEST(CheckNames, AreUniqueAndFitTheTable) {
  std::set<std::string> names;
  for (const Check& check : allChecks()) {
    EXPECT_TRUE(names.insert(check.name).second) << check.name;
    EXPECT_LE(check.name.size() + check.measure.size(), 76u) << check.name;
  }
}

TEST(Finding, WhatIsNotANumberFails) {
  Finding finding(1);
  finding.add(0.5);
  EXPECT_TRUE(finding.passes());
  finding.add(std::nan(""));
  EXPECT_FALSE(finding.passes());
  EXPECT_EQ(finding.worst(), std::numeric_limits<double>::infinity());
}

TEST(Finding, KeepsTheFirstConditionThatDoesNotHold) {
  Finding finding(1);
  finding.require(true, "holds");
  EXPECT_TRUE(finding.passes());
  finding.require(false, "first");
  finding.require(false, "second");
  EXPECT_FALSE(finding.passes());
  EXPECT_EQ(finding.note(), "first");
}

TEST(RunCheck, ErrorsAreFailuresAndSkipsAreNot) {
  const auto verdict_of = [](std::function<Finding(const CheckContext&)> run) {
    return runCheck({"name", "measure", std::move(run)}, {testBench(), 1});
  };
  const CheckResult thrown =
      verdict_of([](const CheckContext&) -> Finding { throw Error("it broke"); });
  EXPECT_EQ(thrown.verdict, Verdict::kFail);
  EXPECT_EQ(thrown.note, "it broke");
  const CheckResult skipped =
      verdict_of([](const CheckContext&) { return Finding::skipped("no such device"); });
  EXPECT_EQ(skipped.verdict, Verdict::kSkipped);
  EXPECT_EQ(skipped.note, "no such device");
  EXPECT_THROW(verdict_of([](const CheckContext&) -> Finding { throw DeviceError("gone"); }),
               DeviceError);
}

}  // namespace
}  // namespace glintmark
