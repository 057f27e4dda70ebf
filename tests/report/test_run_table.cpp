#include "host/report/record/run_table.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "host/report/record/score.h"
#include "host/report/record/text_table.h"
#include "tests/report/sample_records.h"
#include "tests/report/widest_line.h"

namespace glintmark {
namespace {

Record timed(const std::string& name, double value) {
  Record record = sampleRecord(name, "shading_ms", value);
  record.value.stddev = 0.01;
  return record;
}

std::vector<Results> threeRuns() {
  std::vector<Results> runs(
      3, Results{sampleRun(), {timed("snow/steep", 10), timed("car/steep", 20)}});
  runs[1].records[0] = timed("snow/steep", 15);
  runs[2].records.pop_back();
  return runs;
}

TEST(RunTable, HasRatiosToTheFirst) {
  const std::vector<Results> runs = threeRuns();
  const RunTable table = tabulateRuns(runs, {}, 0.05);
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_TRUE(table.hasRegression());
  EXPECT_EQ(table.rows[0].others.at(0)->change, Change::kWorse);
  EXPECT_EQ(table.rows[0].others.at(1)->change, Change::kSame);
  EXPECT_FALSE(table.rows[1].others.at(1));
  const std::vector<std::string> names = {"a", "b", "c"};
  const std::string text = runTableText(table, runs, names, true);
  EXPECT_NE(text.find("zk16 snow/steep  shading_ms  10.0  1.500!  1.000\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("zk16 car/steep   shading_ms  20.0   1.000\n"), std::string::npos) << text;
  const std::string changed = runTableText(table, runs, names, false);
  EXPECT_EQ(changed.find("car/steep"), std::string::npos) << changed;
  EXPECT_NE(changed.find("2 figures compared, 1 of them alike"), std::string::npos) << changed;
  EXPECT_LE(widestLine(text), kTableColumnsLimit);
  const auto json = nlohmann::json::parse(runTableJson(table, names, 0.05));
  EXPECT_EQ(json["schema"], "glintmark.comparisons/1");
  EXPECT_EQ(json["others"][0]["comparison"]["comparisons"][0]["change"], "WORSE");
  EXPECT_EQ(json["others"][1]["file"], "c");
}

TEST(Score, IsAGeometricMeanInAFormThatDoesNotChange) {
  const TableSpec table = {.name = "zk16", .title = "Glints", .score = "shading_ms"};
  std::vector<Record> records = {timed("a", 2), timed("b", 8), timed("c", 1000)};
  records[2].valid = false;
  EXPECT_EQ(scoreLine(table, records), "score: zk16 4 ms 2 cases\n");
  records[2].valid = true;
  records[2].table = "tao21";
  EXPECT_EQ(scoreLine(table, records), "score: zk16 4 ms 2 cases\n");
  records[0].value.median = 1.0 / 3;
  EXPECT_EQ(scoreLine(table, records), "score: zk16 1.63299 ms 2 cases\n");
  EXPECT_EQ(scoreLine({.name = "zk16", .title = "Glints"}, records), "");
  EXPECT_FALSE(scoreOf(table, {}));
}

}  // namespace
}  // namespace glintmark
