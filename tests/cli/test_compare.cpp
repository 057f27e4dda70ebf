// compare on results files written here.
#include <gtest/gtest.h>

#include "host/core/atomic_file.h"
#include "host/report/record/records.h"
#include "tests/cli/process.h"
#include "tests/report/sample_records.h"

namespace glintmark {
namespace {

class Compare : public testing::Test {
 protected:
  std::string write(const std::string& name, const Results& results) {
    std::string file = folder_ / name;
    writeFile(file, toJson(results));
    return file;
  }
  const TempFolder folder_;
};

Results shadingMs(double value) {
  return {sampleRun(), {sampleRecord("snow/steep", "shading_ms", value)}};
}

TEST_F(Compare, ExitCodeTellsARegression) {
  const std::string before = write("before.json", shadingMs(10)),
                    after = write("after.json", shadingMs(20));
  const ProcessResult same = runGlintmark({"compare", before, before});
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_NE(same.out.find("1 figures compared: 1 same"), std::string::npos) << same.out;
  const ProcessResult worse =
      runGlintmark({"compare", before, after, "--json", folder_ / "comparison.json"});
  EXPECT_EQ(worse.exit_code, 1) << worse.err;
  EXPECT_NE(worse.out.find("WORSE"), std::string::npos) << worse.out;
  EXPECT_NE(readFile(folder_ / "comparison.json").find("\"regression\": true"), std::string::npos);
  EXPECT_EQ(runGlintmark({"compare", after, before}).exit_code, 0);
  EXPECT_EQ(runGlintmark({"compare", before, after, "--threshold", "60"}).exit_code, 0);
}

TEST_F(Compare, OtherDevicesAreRefusedUnlessTold) {
  Results other = shadingMs(10);
  other.run.device = "another device";
  const std::string before = write("before.json", shadingMs(10)),
                    after = write("after.json", other);
  const ProcessResult refused = runGlintmark({"compare", before, after});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("another device"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--across-devices"), std::string::npos) << refused.err;
  EXPECT_EQ(runGlintmark({"compare", before, after, "--across-devices"}).exit_code, 0);
}

TEST_F(Compare, RecordsOfANewerSchemaAreNamed) {
  const std::string good = write("good.json", shadingMs(10)), newer = folder_ / "newer.json";
  std::string text = readFile(good);
  text.replace(text.find("glintmark.results/1"), 19, "glintmark.results/2");
  writeFile(newer, text);
  const ProcessResult result = runGlintmark({"compare", good, newer});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find(newer), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("'glintmark.results/2'"), std::string::npos) << result.err;
  EXPECT_EQ(readFile(newer), text);
}

TEST_F(Compare, LosingValidityIsARegression) {
  Results invalid = shadingMs(10);
  invalid.records[0].valid = false;
  const ProcessResult result =
      runGlintmark({"compare", write("before.json", shadingMs(10)), write("after.json", invalid)});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.out.find("was valid and is not any more"), std::string::npos) << result.out;
}

TEST_F(Compare, ManyRunsAreOneTable) {
  const std::string a = write("a.json", shadingMs(10)), b = write("b.json", shadingMs(20)),
                    json = folder_ / "many.json";
  write("results.json", shadingMs(5));
  const ProcessResult result = runGlintmark({"compare", a, b, folder_ / "", "--json", json});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.out.find("2.000!  0.500\n"), std::string::npos) << result.out;
  EXPECT_NE(readFile(json).find("glintmark.comparisons/1"), std::string::npos);
  Results other = shadingMs(10);
  other.run.driver = "another driver";
  const ProcessResult refused = runGlintmark({"compare", a, b, write("c.json", other)});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("another driver"), std::string::npos) << refused.err;
  EXPECT_EQ(runGlintmark({"compare", a}).exit_code, 2);
}

TEST_F(Compare, BadInput) {
  const std::string good = write("good.json", shadingMs(10));
  EXPECT_EQ(runGlintmark({"compare", good, folder_ / "missing.json"}).exit_code, 2);
  EXPECT_EQ(runGlintmark({"compare", good, good, "--threshold", "-1"}).exit_code, 2);
  const std::string empty = write("empty.json", {sampleRun(), {}});
  const ProcessResult nothing = runGlintmark({"compare", good, empty});
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_NE(nothing.err.find("no figure in common"), std::string::npos) << nothing.err;
}

}  // namespace
}  // namespace glintmark
