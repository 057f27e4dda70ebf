// Device clocks that lie: figures come from the wall clock, and say so once and in every record.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/report/record/records.h"
#include "tests/faulty_driver/faulty.h"

namespace glintmark {
namespace {

std::size_t countOf(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

std::vector<std::string> bench(const TempFolder& folder, std::vector<std::string> more = {}) {
  std::vector<std::string> arguments = {"bench",  "zk16",        "--scene", "screen_plane",
                                        "--size", "160x90",      "--reps",  "2",
                                        "-o",     folder / "run"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

double medianOf(const Results& results, const std::string& metric) {
  const auto it = std::ranges::find(results.records, metric, &Record::metric);
  return it == results.records.end() ? -1 : it->value.median;
}

struct BadClock {
  const char* fault;
  const char* sentence;
};

void PrintTo(const BadClock& clock, std::ostream* out) {
  *out << clock.fault;
}

class BadClocks : public testing::TestWithParam<BadClock> {};

nlohmann::json chosenDevice(const std::string& file) {
  return nlohmann::json::parse(readFile(file)).at("chosen");
}

// What `info` measures by a clock that tells the truth.
const nlohmann::json& saneDevice() {
  static const nlohmann::json sane = [] {
    const TempFolder folder;
    const ProcessResult result = runGlintmark({"info", "--json", folder / "sane.json"});
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return chosenDevice(folder / "sane.json");
  }();
  return sane;
}

TEST_P(BadClocks, InfoEndsWithPeaksOfTheWallClock) {
  const TempFolder folder;
  const ProcessResult result =
      runFaulty({"info", "--json", folder / "info.json"}, GetParam().fault);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(countOf(result.err, "note: the clock of '"), 1u) << result.err;
  EXPECT_NE(result.err.find(GetParam().sentence), std::string::npos) << result.err;
  EXPECT_NE(result.out.find("measured by the wall clock"), std::string::npos) << result.out;
  const nlohmann::json found = chosenDevice(folder / "info.json");
  EXPECT_EQ(found["timer"], "wall");
  for (const char* peak : {"peak_gflops", "peak_gbs"}) {
    const double sane = saneDevice()[peak].get<double>();
    EXPECT_GT(found[peak].get<double>(), 0.1 * sane) << peak;
    EXPECT_LT(found[peak].get<double>(), 10 * sane) << peak;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, BadClocks,
    testing::Values(
        BadClock{"clock=zero", "it says that a launch took 0 ns"},
        BadClock{"clock=backwards", "ended 1000 ns before it began"},
        BadClock{"clock=still", "it says that a launch took 1 ns"},
        BadClock{"clock=ticks", "for launches that take"},
        BadClock{"clock=fast", "for launches that take"},
        BadClock{"clock=long", "for a launch that the wall clock saw end after"},
        BadClock{"clock=absent", "it does not say when commands ran"},
        BadClock{"clock=no_queue", "it does not say when commands ran"},
        // Which launch shows a coarse step first is chance; the sentence is DeviceClock's test's.
        BadClock{"step=10000000", ""}, BadClock{"step=100000", ""}),
    [](const auto& tested) {
      std::string name = tested.param.fault;
      std::ranges::replace(name, '=', '_');
      return name;
    });

TEST(Clocks, EveryRecordNamesItsClock) {
  const TempFolder folder;
  ASSERT_EQ(runFaulty(bench(folder, {"--quiet"}), "clock=backwards").exit_code, 0);
  const Results results = readResults(folder / "run/results.json");
  ASSERT_FALSE(results.records.empty());
  for (const Record& record : results.records) EXPECT_EQ(record.timer, "wall") << record.metric;
  EXPECT_NE(readFile(folder / "run/table.txt").find("timed by the wall clock"), std::string::npos);
  const double by_event = medianOf(results, "shading_event_ms");
  EXPECT_GT(by_event, 0.01);
  EXPECT_LT(by_event, 1e4);
}

TEST(Clocks, ASaneDeviceTimesItself) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(bench(folder));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.find("clock of"), std::string::npos) << result.err;
  for (const Record& record : readResults(folder / "run/results.json").records)
    EXPECT_EQ(record.timer, "device") << record.metric;
}

TEST(Clocks, TheWallClockCanBeChosen) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(bench(folder, {"--timer", "wall"}));
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.find("clock of"), std::string::npos) << result.err;
  for (const Record& record : readResults(folder / "run/results.json").records)
    EXPECT_EQ(record.timer, "wall") << record.metric;
}

TEST(Clocks, ADeviceClockThatWasAskedForIsRefusedWhereItLies) {
  for (const char* fault : {"clock=zero", "clock=backwards", "clock=absent", "clock=long"}) {
    const ProcessResult result = runFaulty({"info", "--timer", "device"}, fault);
    EXPECT_EQ(result.exit_code, 2) << fault;
    EXPECT_NE(result.err.find("cannot be used"), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("use --timer wall or auto"), std::string::npos) << result.err;
  }
  const ProcessResult unknown = runGlintmark({"info", "--timer", "sun"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("none of auto, device and wall"), std::string::npos) << unknown.err;
}

TEST(Clocks, APictureNeedsNoClock) {
  const TempFolder folder;
  const auto render = [&](const char* file) {
    return std::vector<std::string>{"render", "screen_plane", "--size",  "160x90",
                                    "-o",     folder / file,  "--trace", folder / "trace.json"};
  };
  ASSERT_EQ(runGlintmark(render("sane.exr")).exit_code, 0);
  for (const char* fault : {"clock=absent", "clock=still", "clock=zero"}) {
    const ProcessResult result = runFaulty(render("faulty.exr"), fault);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find("by the wall clock"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("shading 0.0 ms"), std::string::npos) << result.out;
    EXPECT_TRUE(samePixels(folder / "faulty.exr", folder / "sane.exr")) << fault;
  }
}

}  // namespace
}  // namespace glintmark
