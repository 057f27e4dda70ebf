// bench zk16 on small pictures: files, resuming, interruption.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>
#include <sstream>
#include <thread>

#include "host/core/atomic_file.h"
#include "host/report/record/records.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

using std::chrono::steady_clock;

std::vector<std::string> benchArguments(const TempFolder& folder,
                                        const std::vector<std::string>& more) {
  std::vector<std::string> arguments = {"bench",        "zk16", "--quiet",   "--scene",
                                        "screen_plane", "-o",   folder / "r"};
  if (std::ranges::find(more, "--size") == more.end())
    arguments.insert(arguments.end(), {"--size", "320x180"});
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

std::size_t lineCount(const std::filesystem::path& file) {
  if (!std::filesystem::exists(file)) return 0;
  const std::string text = readFile(file);
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool waitForLines(const std::filesystem::path& file, std::size_t lines) {
  const auto give_up = steady_clock::now() + kPatience;
  while (steady_clock::now() < give_up) {
    if (lineCount(file) >= lines) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

TEST(Bench, StopsWhenKnownOrWhenTimeIsOver) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark(benchArguments(folder, {"--size", "64x36", "--view", "steep", "--noise", "99",
                                           "--reps", "1", "--warmup", "2"}));
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_NE(result.out.find("\nscore: zk16 "), std::string::npos) << result.out;
  for (const Record& record : readResults(folder / "r/results.json").records) {
    EXPECT_EQ(record.config.at("noise"), "0.99");
    EXPECT_EQ(record.config.at("warmup"), "2");
    if (record.metric == "shading_event_ms") {
      EXPECT_GE(record.value.n, 3u);
    }
  }
  const ProcessResult late = runGlintmark(benchArguments(folder, {"--max-time", "1e-6"}));
  EXPECT_EQ(late.exit_code, 2);
  EXPECT_NE(late.err.find("too short for one repetition of zk16 screen_plane/steep"),
            std::string::npos)
      << late.err;
  for (const char* wrong : {"--noise", "--max-time", "--warmup"})
    EXPECT_EQ(runGlintmark(benchArguments(folder, {wrong, "-1"})).exit_code, 2) << wrong;
}

TEST(Bench, WritesEveryFile) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(benchArguments(
      folder, {"--reps", "3", "--json", folder / "copy.json", "--csv", folder / "copy.csv"}));
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_EQ(result.err, "");

  const Results results = readResults(folder / "r/results.json");
  EXPECT_GT(results.run.peak_gflops, 0);
  EXPECT_FALSE(results.run.device.empty());
  std::set<std::string> metrics;
  for (const Record& record : results.records) {
    EXPECT_TRUE(record.valid) << record.case_ << " " << record.metric << ": " << record.note;
    EXPECT_FALSE(record.paper && record.metric == "shading_ms");  // the paper's is 1920x1080
    if (record.case_ == "screen_plane/steep") metrics.insert(record.metric);
    EXPECT_TRUE(record.config.contains("kernels"));
  }
  for (const char* metric :
       {"shading_ms", "shading_event_ms", "ns_per_cell", "ns_per_paid_cell", "speedup_vs_w1",
        "cells_min", "cells_mean", "cells_paid_mean", "cells_max", "guard_hits", "raster_ms",
        "upload_ms", "readback_ms", "build_ms", "first_enqueue_ms", "triangles", "covered_px",
        "glint_share", "buffer_bytes_per_px"}) {
    EXPECT_TRUE(metrics.contains(metric)) << metric;
  }
  EXPECT_EQ(lineCount(folder / "r/records.jsonl"), results.records.size() + 1);
  EXPECT_EQ(lineCount(folder / "r/results.csv"), results.records.size() + 1);
  EXPECT_EQ(readFile(folder / "copy.json"), readFile(folder / "r/results.json"));
  EXPECT_EQ(readFile(folder / "copy.csv"), readFile(folder / "r/results.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder / "r/cells_screen_plane_steep.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "r/cells_screen_plane_grazing.png"));

  std::istringstream table(readFile(folder / "r/table.txt"));
  for (std::string line; std::getline(table, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Bench, InterruptKeepsRecordsAndResumeCompletesThem) {
  const TempFolder folder;
  const auto arguments = benchArguments(folder, {"--reps", "25"});
  Process process(arguments);
  // The first view's records are on the disk; the second is being measured.
  ASSERT_TRUE(waitForLines(folder / "r/records.jsonl", 2));
  process.interrupt();
  const ProcessResult interrupted = process.wait();
  EXPECT_EQ(interrupted.exit_code, 130) << interrupted.err << interrupted.out;
  // Not at the start: a compiler that was at work may say that it failed.
  EXPECT_NE(interrupted.err.find("glintmark: interrupted; 1 of 2 cases of table zk16 are kept"),
            std::string::npos)
      << interrupted.err;
  EXPECT_NE(interrupted.err.find("--resume"), std::string::npos) << interrupted.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "r/results.json"));
  const std::string kept = readFile(folder / "r/records.jsonl");

  auto resume = arguments;
  resume.push_back("--resume");
  const ProcessResult resumed = runGlintmark(resume);
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_TRUE(readFile(folder / "r/records.jsonl").starts_with(kept));
  std::set<std::string> cases;
  for (const Record& record : readResults(folder / "r/results.json").records) {
    cases.insert(record.case_);
  }
  EXPECT_EQ(cases, (std::set<std::string>{"screen_plane/steep", "screen_plane/grazing"}));

  // Nothing is left to measure now: the log stays as it is.
  const std::string whole = readFile(folder / "r/records.jsonl");
  EXPECT_EQ(runGlintmark(resume).exit_code, 0);
  EXPECT_EQ(readFile(folder / "r/records.jsonl"), whole);
}

TEST(Bench, DamagedLogIsAnErrorOnlyForResume) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "r");
  writeFile(folder / "r/records.jsonl", "{\"schema\":\"glintmark.results/7\",\"run\":{}}\n");
  const ProcessResult resumed = runGlintmark(benchArguments(folder, {"--resume"}));
  EXPECT_EQ(resumed.exit_code, 2);
  EXPECT_NE(resumed.err.find("glintmark.results/7"), std::string::npos) << resumed.err;
  const ProcessResult fresh =
      runGlintmark(benchArguments(folder, {"--reps", "1", "--view", "steep"}));
  EXPECT_EQ(fresh.exit_code, 0) << fresh.err;
}

TEST(Bench, EffectsOfOneSetResumedAfterAnInterrupt) {
  const TempFolder folder;
  const std::vector<std::string> arguments = {
      "bench", "effects", "--quiet",         "--reps", "1",         "--size",
      "64x36", "--set",   "mesh.detail=0.1", "-o",     folder / "r"};
  Process process(arguments);
  ASSERT_TRUE(waitForLines(folder / "r/records.jsonl", 2));
  process.interrupt();
  const ProcessResult interrupted = process.wait();
  EXPECT_EQ(interrupted.exit_code, 130) << interrupted.err << interrupted.out;
  EXPECT_NE(interrupted.err.find("of table effects are kept"), std::string::npos)
      << interrupted.err;
  const std::string kept = readFile(folder / "r/records.jsonl");
  EXPECT_NE(kept.find("\"case\":\"none\""), std::string::npos);
  for (const char* metric : {"shading_ms", "uber_over_specialised", "planes_bytes", "tables_bytes",
                             "peak_bytes", "build_ms"})
    EXPECT_NE(kept.find(metric), std::string::npos) << metric;
  EXPECT_EQ(kept.find("\"valid\":false"), std::string::npos) << kept;

  auto resume = arguments;
  resume.push_back("--resume");
  Process resumed(resume);
  ASSERT_TRUE(waitForLines(folder / "r/records.jsonl", lineCount(folder / "r/records.jsonl") + 1));
  resumed.interrupt();
  resumed.wait();
  EXPECT_TRUE(readFile(folder / "r/records.jsonl").starts_with(kept));
}

TEST(Bench, MethodsOfGlintsSideBySide) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"bench", "glints", "--quiet", "--view", "aspect4", "--size", "160x90", "--reps",
                    "2", "-o", folder / "r"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  std::set<std::string> methods;
  std::map<std::string, double> visited;
  for (const Record& record : readResults(folder / "r/results.json").records) {
    EXPECT_TRUE(record.valid) << record.case_ << " " << record.metric << ": " << record.note;
    const std::string method = record.case_.substr(0, record.case_.find('/'));
    methods.insert(method);
    if (record.case_ == method + "/aspect=4/lambda=10/lights=3" && record.metric == "visited_mean")
      visited[method] = record.value.median;
    if (record.metric == "error_over_best") {
      EXPECT_GE(record.value.median, 1) << record.case_;
    }
  }
  for (const char* method :
       {"zk16", "distributed", "deliot_belcour", "kemppinen", "chermain", "chermain_corrected"})
    EXPECT_TRUE(methods.contains(method)) << method;
  EXPECT_EQ(visited["deliot_belcour"], 3 * 48);
  EXPECT_EQ(visited["kemppinen"], 3 * 32);
  EXPECT_EQ(visited["zk16"], visited["distributed"]);
  std::istringstream lines(readFile(folder / "r/table.txt"));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Bench, AreaLightsOfEveryShape) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"bench", "tao21", "--quiet", "--scene", "area_plane", "--size", "160x90",
                    "--reps", "5", "--width", "8", "-o", folder / "r"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  std::map<std::string, double> least_ms;
  for (const Record& record : readResults(folder / "r/results.json").records) {
    EXPECT_TRUE(record.valid) << record.case_ << " " << record.metric << ": " << record.note;
    if (record.metric == "shading_ms") least_ms[record.case_] = record.value.min;
  }
  const double quad_ms = least_ms["area_plane/vertices=4"];
  EXPECT_GT(quad_ms, 0);
  // They are no polygons: arcs take longer than edges.
  for (const char* shape : {"disc", "sphere", "tube"})
    EXPECT_GT(least_ms[std::string("area_plane/shape=") + shape], 1.2 * quad_ms) << shape;
  std::istringstream lines(readFile(folder / "r/table.txt"));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 100u) << line;
}

TEST(Bench, ResumingLooksAtWhatFilesHold) {
  const TempFolder folder;
  const std::string quad = "v 0 0 0\nv 1 0 0\nv 1 0 -1\nv 0 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
  const std::string mesh = folder / "quad.obj";
  writeFile(mesh, quad + "f 1/1 2/2 3/3 4/4\n");
  const auto bench = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"bench",  "zk16",   "--quiet", "--scene", "screen_plane",
                                          "--view", "steep",  "--size",  "64x36",   "--reps",
                                          "1",      "--mesh", mesh,      "-o",      folder / "r"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return runGlintmark(arguments);
  };
  EXPECT_EQ(bench({}).exit_code, 0);
  EXPECT_EQ(bench({"--resume"}).exit_code, 0);
  writeFile(mesh, quad + "f 1/1 2/2 3/3\n");
  const ProcessResult changed = bench({"--resume"});
  EXPECT_EQ(changed.exit_code, 2);
  EXPECT_NE(changed.err.find("kernels, tables, scenes and meshes"), std::string::npos)
      << changed.err;
}

}  // namespace
}  // namespace glintmark
