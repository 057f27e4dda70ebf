// What ranks tell each other of cases, and who measures which.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "host/core/error.h"
#include "host/experiment/case_message.h"

namespace glintmark {
namespace {

Record someRecord(double value) {
  Record record;
  record.table = "zk16";
  record.case_ = "snow/steep";
  record.metric = "shading_ms";
  record.unit = "ms";
  record.value.median = value;
  record.note = "two\nlines";
  return record;
}

TEST(CaseMessage, RecordsArriveAsTheyWere) {
  const CaseMessage sent{.index = 17, .records = {someRecord(0.1), someRecord(1.0 / 3)}};
  const CaseMessage got = unpackMessage(packMessage(sent));
  EXPECT_EQ(got.index, 17u);
  EXPECT_EQ(got.file, "");
  ASSERT_EQ(got.records.size(), 2u);
  EXPECT_EQ(got.records[0].value.median, 0.1);
  EXPECT_EQ(got.records[1].value.median, 1.0 / 3);
  EXPECT_EQ(got.records[1].note, "two\nlines");
}

TEST(CaseMessage, FilesArriveAsTheyWere) {
  const std::string bytes("\x89PNG\n\0\n more", 12);
  const CaseMessage got = unpackMessage(packMessage({.file = "a_b.png", .content = bytes}));
  EXPECT_EQ(got.file, "a_b.png");
  EXPECT_EQ(got.content, bytes);
  EXPECT_EQ(unpackMessage(packMessage({.file = "empty.png"})).content, "");
}

TEST(CaseMessage, ALeftOutCaseHasNoRecords) {
  EXPECT_TRUE(unpackMessage(packMessage({.index = 3})).records.empty());
}

TEST(CaseMessage, WhatIsCutOffIsRefused) {
  const std::string whole = packMessage({.index = 1, .records = {someRecord(1), someRecord(2)}});
  EXPECT_THROW(unpackMessage(""), Error);
  EXPECT_THROW(unpackMessage(whole.substr(0, whole.size() / 3)), Error);
  EXPECT_THROW(unpackMessage("1 2 \n"), Error);
}

TEST(DealCases, KeepsAViewsMethodsTogether) {
  const std::vector<std::string> cases = {"disk/near/gmm", "disk/near/lean",   "disk/far/gmm",
                                          "disk/far/lean", "disk/far/toksvig", "all"};
  EXPECT_EQ(dealCases(cases, {0, 3}), (std::vector<int>{0, 0, 3, 3, 3, 0}));
  EXPECT_EQ(dealCases(cases, {0}), std::vector<int>(6, 0));
  EXPECT_TRUE(dealCases({}, {0, 1}).empty());
}

TEST(DealCases, TellsValuesOfKnobsApart) {
  const std::vector<std::string> cases = {"ltc/edges=acos",
                                          "ltc/edges=exact",
                                          "ltc/table=8",
                                          "area/near/tao21/roughness=0.1",
                                          "area/near/exact/roughness=0.1",
                                          "area/near/exact/roughness=0.2"};
  EXPECT_EQ(dealCases(cases, {0, 1}), (std::vector<int>{0, 1, 0, 1, 1, 0}));
}

}  // namespace
}  // namespace glintmark
