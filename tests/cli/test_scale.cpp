// scale on small pictures: what is turned, what a device cannot do, what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "host/report/record/records.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

std::vector<std::string> scaleArguments(const TempFolder& folder,
                                        const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {
      "scale", "screen_plane", "--quiet", "--size", "320x180", "--reps", "5", "-o", folder / "r"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(Scale, TurnsPixelsLanesAndThreads) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(scaleArguments(folder, {"--up-to", "360"}));
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  std::set<std::string> cases;
  for (const Record& record : readResults(folder / "r/results.json").records) {
    cases.insert(record.case_);
    EXPECT_TRUE(record.valid) << record.case_ << " " << record.note;
    EXPECT_GT(record.value.median, 0) << record.case_ << " " << record.metric;
    if (record.metric == "ns_per_px" && record.case_ == "screen_plane/steep/height=360") {
      EXPECT_LT(record.value.median, 1e5);
    }
    // One against itself, in turn.
    if (record.metric == "speedup" && record.case_.ends_with("=1")) {
      EXPECT_NEAR(record.value.median, 1, 0.9);
    }
  }
  std::set<std::string> wanted = {"screen_plane/steep/height=360"};
  for (const int lanes : {1, 4, 8, 16})
    wanted.insert("screen_plane/steep/lanes=" + std::to_string(lanes));
  EXPECT_TRUE(std::ranges::includes(cases, wanted)) << result.out;
  EXPECT_TRUE(cases.contains("screen_plane/steep/threads=1") ||
              result.out.find("threads left out: ") != std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("\nscore: scaling "), std::string::npos) << result.out;
}

TEST(Scale, RefusesWhatItDoesNotKnow) {
  const TempFolder folder;
  const auto refused = [&](const std::vector<std::string>& more, const char* sentence) {
    const ProcessResult result = runGlintmark(scaleArguments(folder, more));
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
  };
  refused({"--axis", "width"}, "unknown axis 'width'; axes are height, lanes, threads");
  refused({"--up-to", "359"}, "--up-to 359 is not a height from 360 to 16384 pixels");
  refused({"--view", "below"}, "steep");
}

}  // namespace
}  // namespace glintmark
