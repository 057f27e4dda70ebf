// report on a results folder written here.
#include <gtest/gtest.h>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/records.h"
#include "tests/cli/process.h"
#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

class Report : public testing::Test {
 protected:
  void writeResults() {
    const Results results{sampleRun(), {sampleRecord("snow/steep", "shading_ms", 42)}};
    writeFile(folder_ / "results.json", toJson(results));
  }
  const TempFolder folder_;
};

TEST_F(Report, OnePageWithThePicturesOfTheFolder) {
  writeResults();
  writePng(Image(4, 4, 3), folder_ / "cells_snow_steep.png");
  const std::string page = folder_ / "page.html";
  const ProcessResult result = runGlintmark({"report", folder_ / "", "-o", page});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("1 figures and 1 pictures"), std::string::npos) << result.out;
  const std::string html = readFile(page);
  EXPECT_NE(html.find("<a href=\"./results.json\">"), std::string::npos);
  EXPECT_NE(html.find("cells_snow_steep.png"), std::string::npos);
}

TEST_F(Report, ManyRunsAreOnePage) {
  const std::string page = folder_ / "page.html";
  for (const char* name : {"a", "b"}) {
    std::filesystem::create_directories(folder_ / name);
    Results results{sampleRun(), {sampleRecord("snow/steep", "shading_event_ms", 42)}};
    results.run.device = std::string("device ") + name;
    writeFile(folder_ / name / "results.json", toJson(results));
  }
  for (const std::vector<std::string>& folders :
       {std::vector<std::string>{folder_ / ""}, {folder_ / "a", folder_ / "b"}}) {
    std::vector<std::string> arguments = {"report", "-o", page};
    arguments.insert(arguments.end(), folders.begin(), folders.end());
    const ProcessResult result = runGlintmark(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out, "2 runs written to " + page + "\n");
    const std::string html = readFile(page);
    EXPECT_NE(html.find("<a href=\"./b/results.json\">device b</a>"), std::string::npos);
  }
}

TEST_F(Report, BadInputLeavesNoPage) {
  const std::string page = folder_ / "page.html";
  EXPECT_EQ(runGlintmark({"report", folder_ / "missing", "-o", page}).exit_code, 2);
  const ProcessResult no_results = runGlintmark({"report", folder_ / "", "-o", page});
  EXPECT_EQ(no_results.exit_code, 2);
  EXPECT_NE(no_results.err.find("results.json"), std::string::npos) << no_results.err;
  writeResults();
  std::string text = readFile(folder_ / "results.json");
  text.insert(text.find("glintmark.results/") + 18, "9");
  writeFile(folder_ / "results.json", text);
  EXPECT_EQ(runGlintmark({"report", folder_ / "", "-o", page}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(page));
  writeResults();
  EXPECT_EQ(runGlintmark({"report", folder_ / "", "-o", folder_ / "no/such/page.html"}).exit_code,
            2);
}

}  // namespace
}  // namespace glintmark
