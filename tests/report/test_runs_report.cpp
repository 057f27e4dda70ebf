#include "host/report/page/runs_report.h"

#include <gtest/gtest.h>

#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

std::vector<NamedResults> twoDevices() {
  std::vector<NamedResults> runs(
      2, {"a/results.json", {sampleRun(), {sampleRecord("snow/steep", "shading_ms", 42)}}});
  runs[1].source = "b c/results.json";
  runs[1].results.run.device = "other <device>";
  runs[1].results.run.date = "2025-01-02T00:00:00Z";
  runs[1].results.records[0].value.median = 10;
  runs[1].results.records.push_back(sampleRecord("x", "other_ms", 1));
  runs[1].results.records.back().table = "mine";
  return runs;
}

const std::vector<TableSpec> kTables = {{.name = "zk16",
                                         .title = "Glints",
                                         .metrics = {{"shading_ms", "ms", "shading time"}},
                                         .score = "shading_ms"}};

TEST(RunsReport, PutsRunsSideBySide) {
  const std::string html = runsReport(twoDevices(), kTables);
  const auto has = [&](const std::string& part) { return html.find(part) != std::string::npos; };
  EXPECT_TRUE(has("<h2 id=\"zk16\">Glints</h2>"));
  EXPECT_TRUE(
      has("data-labels=\"cpu-device, 16 lanes, 2024-05-06;other &lt;device&gt;, 16 lanes, "
          "2025-01-02\" data-values=\"42;10\""));
  EXPECT_TRUE(has("<a href=\"./b%20c/results.json\">other &lt;device&gt;</a>"));
  EXPECT_TRUE(has("<td data-key=\"10\"><b>10.0</b></td><td data-key=\"10\">10.0</td>"));
  EXPECT_TRUE(has("<th scope=\"col\">snow/steep</th>"));
  // A table that nobody knows says how many records a run has.
  EXPECT_TRUE(has("<h2 id=\"mine\">mine</h2>"));
  EXPECT_TRUE(has("<th scope=\"col\">records</th>"));
  EXPECT_FALSE(has("http://"));
}

}  // namespace
}  // namespace glintmark
