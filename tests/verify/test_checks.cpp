// Every check of `glintmark verify`, group by group.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "host/core/error.h"
#include "host/verify/check.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

// Which lanes a check runs at: one and the device's own count; one that compares lanes at all.
std::vector<int> lanesOf(const Check& check) {
  const int device_lanes = testBench().device.info().default_lanes;
  if (check.name.find("same_bits") != std::string::npos) return {4, 8, device_lanes};
  return {1, device_lanes};
}

std::string groupOf(const Check& check) {
  return check.name.substr(0, check.name.find('/'));
}

std::vector<std::string> allGroups() {
  std::vector<std::string> groups;
  for (const Check& check : allChecks())
    if (std::ranges::find(groups, groupOf(check)) == groups.end()) groups.push_back(groupOf(check));
  return groups;
}

// A group is a test and a process: its checks share programs, which take longer to compile than to
// run.
class CheckGroups : public testing::TestWithParam<std::string> {};

TEST_P(CheckGroups, Pass) {
  int skipped = 0, run = 0;
  std::string reason;
  for (const Check& check : allChecks()) {
    if (groupOf(check) != GetParam()) continue;
    for (const int lanes : lanesOf(check)) {
      const CheckResult result = runCheck(check, {testBench(), lanes});
      ++run;
      if (result.verdict == Verdict::kSkipped) {
        ++skipped;
        reason = result.note;
        continue;
      }
      EXPECT_EQ(result.verdict, Verdict::kPass)
          << check.name << " at " << lanes << " lanes, " << check.measure << ": " << result.worst
          << ", bound " << result.bound << "; " << result.note;
    }
  }
  if (skipped == run) GTEST_SKIP() << reason;
}

INSTANTIATE_TEST_SUITE_P(All, CheckGroups, testing::ValuesIn(allGroups()),
                         [](const auto& group) { return group.param; });

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
