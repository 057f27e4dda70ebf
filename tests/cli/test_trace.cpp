// --trace of render and bench: a well-formed trace whose intervals nest, the device's inside the
// host's.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "host/core/atomic_file.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

using Json = nlohmann::json;

// Times are microseconds in double precision; sums of two are good to far below a nanosecond.
constexpr double kRoundingUs = 1e-3;

double beginOf(const Json& event) {
  return event.at("ts").get<double>();
}
double endOf(const Json& event) {
  return beginOf(event) + event.at("dur").get<double>();
}
bool encloses(const Json& outer, const Json& inner) {
  return beginOf(outer) <= beginOf(inner) + kRoundingUs &&
         endOf(outer) >= endOf(inner) - kRoundingUs;
}

struct Trace {
  std::vector<Json> host, device;
  std::vector<std::string> names;  // of processes and threads

  explicit Trace(const std::filesystem::path& file) {
    const Json json = Json::parse(readFile(file));
    EXPECT_FALSE(json.at("otherData").at("device").get<std::string>().empty());
    EXPECT_FALSE(json.at("otherData").at("git").get<std::string>().empty());
    for (const Json& event : json.at("traceEvents")) {
      if (event.at("ph") == "M") {
        names.push_back(event.at("args").at("name"));
        continue;
      }
      EXPECT_EQ(event.at("ph"), "X");
      EXPECT_GE(event.at("dur").get<double>(), 0);
      (event.at("pid") == 1 ? host : device).push_back(event);
    }
  }

  std::vector<Json> hostNamed(const std::string& category, const std::string& name) const {
    std::vector<Json> found;
    for (const Json& event : host)
      if (event.at("cat") == category && event.at("name") == name) found.push_back(event);
    return found;
  }
};

void expectWellFormed(const Trace& trace) {
  EXPECT_GE(trace.names.size(), 4u);
  // Begins never go back, and on each thread intervals nest: none ends after one that it began in.
  std::map<int, std::vector<Json>> open;
  double last = 0;
  for (const Json& event : trace.host) {
    EXPECT_GE(beginOf(event), last);
    last = beginOf(event);
    std::vector<Json>& stack = open[event.at("tid").get<int>()];
    while (!stack.empty() && endOf(stack.back()) <= beginOf(event)) stack.pop_back();
    if (!stack.empty()) {
      EXPECT_TRUE(encloses(stack.back(), event)) << event;
    }
    stack.push_back(event);
  }
  // The queue is in order: commands follow one another.
  last = 0;
  for (const Json& event : trace.device) {
    EXPECT_GE(beginOf(event), last - kRoundingUs) << event;
    last = endOf(event);
    EXPECT_FALSE(event.at("args").contains("note")) << event;
  }
}

bool isInsideOne(const Json& event, const std::vector<Json>& intervals) {
  return std::ranges::any_of(intervals, [&](const Json& i) { return encloses(i, event); });
}

TEST(TraceFile, OfARenderedFrame) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"render", "screen_plane", "--quiet", "--size", "160x90", "-o", folder / "p.exr",
                    "--trace", folder / "trace.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(folder.entryCount(), 2u);
  const Trace trace(folder / "trace.json");
  expectWellFormed(trace);
  for (const char* name : {"frame", "prepare", "rasterize", "shade", "read back"})
    EXPECT_EQ(trace.hostNamed("frame", name).size(), 1u) << name;
  std::size_t kernels = 0;
  for (const Json& event : trace.device) {
    EXPECT_TRUE(isInsideOne(event, trace.hostNamed("frame", "frame"))) << event;
    if (event.at("cat") != "kernel") continue;
    ++kernels;
    EXPECT_EQ(event.at("name"), "shade");
    EXPECT_TRUE(isInsideOne(event, trace.hostNamed("frame", "shade"))) << event;
  }
  EXPECT_EQ(kernels, 1u);
}

TEST(TraceFile, OfABench) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(
      {"bench", "zk16", "--quiet", "--scene", "screen_plane", "--view", "steep", "-o", folder / "r",
       "--size", "160x90", "--reps", "3", "--trace", folder / "trace.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  const Trace trace(folder / "trace.json");
  expectWellFormed(trace);
  EXPECT_EQ(trace.hostNamed("case", "zk16/screen_plane/steep").size(), 1u);
  std::size_t shaded = 0;
  for (const Json& event : trace.device)
    if (event.at("cat") == "kernel" && event.at("name") == "shade") {
      ++shaded;
      EXPECT_TRUE(isInsideOne(event, trace.hostNamed("frame", "shade"))) << event;
    }
  EXPECT_GE(shaded, 3u);
}

TEST(TraceFile, IsInTheHelp) {
  for (const char* command : {"render", "bench"})
    EXPECT_NE(runGlintmark({command, "--help"}).out.find("--trace FILE"), std::string::npos);
}

TEST(TraceFile, IsRefusedBeforeAnyWorkWhereItCannotBeWritten) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(
      {"render", "screen_plane", "-o", folder / "p.exr", "--trace", folder / "missing/t.json"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(folder.entryCount(), 0u);
}

}  // namespace
}  // namespace glintmark
