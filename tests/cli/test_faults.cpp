// What goes wrong around a run: kills, a full disk, folders of others.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <map>
#include <random>
#include <sstream>
#include <thread>

#include "host/core/atomic_file.h"
#include "host/report/record/records.h"
#include "tests/cli/process.h"
#include "tests/experiment/sample_run.h"

namespace glintmark {
namespace {

using std::chrono::steady_clock;

constexpr int kKills = 4;

std::vector<std::string> sweep(const std::filesystem::path& folder,
                               const std::vector<std::string>& more = {}, const char* reps = "3") {
  std::vector<std::string> arguments = {"bench",        "zk16",   "--quiet", "--scene",
                                        "screen_plane", "--size", "160x90",  "--reps",
                                        reps,           "-o",     folder};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

// How often each record stands in a file of results or in a log. Without the lengths of machine
// code, which are left out where no temporary file can be written.
std::map<std::string, int> countsOf(const std::vector<Record>& records) {
  std::map<std::string, int> counts;
  for (const Record& record : records)
    if (!record.metric.ends_with("_instructions"))
      ++counts[record.table + " " + record.case_ + " " + record.metric];
  return counts;
}

std::vector<Record> logRecords(const std::filesystem::path& file) {
  std::istringstream lines(readFile(file));
  std::vector<Record> records;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) records.push_back(parseRecordLine(line, "log").record);
  return records;
}

bool waitForFile(const std::filesystem::path& file, const Process& writer) {
  const auto give_up = steady_clock::now() + kPatience;
  while (!std::filesystem::exists(file)) {
    if (steady_clock::now() > give_up || !writer.isRunning()) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return true;
}

TEST(Faults, KilledAtAnyMomentAndResumedEveryRecordIsThereOnce) {
  const TempFolder folder;
  ASSERT_EQ(runGlintmark(sweep(folder / "warm")).exit_code, 0);  // kernels are built now
  const auto begin = steady_clock::now();
  ASSERT_EQ(runGlintmark(sweep(folder / "whole")).exit_code, 0);
  const std::chrono::duration<double> whole = steady_clock::now() - begin;

  const auto seed = std::random_device()();
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::minstd_rand random(seed);
  std::uniform_real_distribution<double> moment(0, whole.count());
  const std::filesystem::path killed = folder / "killed";
  int running = 0;
  for (int k = 0; k < kKills; ++k) {
    Process process(sweep(killed, {"--resume"}));
    std::this_thread::sleep_for(std::chrono::duration<double>(moment(random)));
    running += process.isRunning() ? 1 : 0;
    process.kill();
    process.wait();
  }
  EXPECT_GT(running, 0) << "no kill met a run";
  const ProcessResult last = runGlintmark(sweep(killed, {"--resume"}));
  ASSERT_EQ(last.exit_code, 0) << last.err;
  const auto expected = countsOf(readResults(folder / "whole/results.json").records);
  EXPECT_EQ(countsOf(readResults(killed / "results.json").records), expected);
  EXPECT_EQ(countsOf(logRecords(killed / "records.jsonl")), expected);
  for (const auto& [name, count] : expected) EXPECT_EQ(count, 1) << name;
  // No temporary file of a killed run and no lock stays behind.
  for (const auto& entry : std::filesystem::directory_iterator(killed))
    EXPECT_FALSE(entry.path().filename().string().starts_with('.')) << entry.path();
}

TEST(Faults, AFullDiskKeepsWhatIsWrittenAndResumeCompletesIt) {
  const TempFolder folder;
  // PoCL writes files when it builds from source, and ends the process where it cannot.
  const std::vector<std::string> stored = {"GLINTMARK_PROGRAM_CACHE=on"};
  ASSERT_EQ(runGlintmark(sweep(folder / "whole"), stored).exit_code, 0);
  const auto log_bytes = std::filesystem::file_size(folder / "whole/records.jsonl");
  const std::filesystem::path full = folder / "full";
  // The log takes its first view, not its second.
  const ProcessResult stopped = Process(sweep(full), stored, log_bytes * 3 / 4).wait();
  EXPECT_EQ(stopped.exit_code, 2) << stopped.err << stopped.out;
  EXPECT_TRUE(stopped.err.starts_with("glintmark: cannot write ")) << stopped.err;
  EXPECT_EQ(std::count(stopped.err.begin(), stopped.err.end(), '\n'), 1) << stopped.err;
  EXPECT_FALSE(std::filesystem::exists(full / "results.json"));
  const std::string kept = readFile(full / "records.jsonl");
  ASSERT_EQ(runGlintmark(sweep(full, {"--resume"})).exit_code, 0);
  EXPECT_TRUE(readFile(full / "records.jsonl").starts_with(kept));
  EXPECT_EQ(countsOf(readResults(full / "results.json").records),
            countsOf(readResults(folder / "whole/results.json").records));
}

TEST(Faults, AFullDiskLeavesTheOldPage) {
  const TempFolder folder;
  writeFile(folder / "results.json", toJson(SampleRun().results()));
  writeFile(folder / "page.html", "old");
  const ProcessResult result =
      Process({"report", folder.path(), "-o", folder / "page.html"}, {}, 4096).wait();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("cannot write"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("page.html"), std::string::npos) << result.err;
  EXPECT_EQ(readFile(folder / "page.html"), "old");
  EXPECT_EQ(folder.entryCount(), 2u);
}

TEST(Faults, AFolderInUseIsLeftAlone) {
  const TempFolder folder;
  const std::filesystem::path shared = folder / "shared";
  Process first(sweep(shared, {}, "500"));
  ASSERT_TRUE(waitForFile(shared / "records.jsonl", first));
  const ProcessResult second = runGlintmark(sweep(shared));
  EXPECT_EQ(second.exit_code, 2);
  EXPECT_NE(second.err.find("is in use by another run (process "), std::string::npos) << second.err;
  // A terminal that closes is a request to end; timeout(1), say, makes each request twice.
  first.send(SIGHUP);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // or the system makes one of both
  first.send(SIGHUP);
  const ProcessResult ended = first.wait();
  EXPECT_EQ(ended.exit_code, 129);
  EXPECT_NE(ended.err.find("are kept in"), std::string::npos) << ended.err;
  EXPECT_EQ(runGlintmark(sweep(shared)).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(shared / "records.jsonl.old"));
}

// /proc takes no files, not even root's.
TEST(Faults, AReadOnlyFolderIsSaid) {
  const ProcessResult result = runGlintmark(sweep("/proc"));
  EXPECT_EQ(result.exit_code, 2);
  // Others than root may not even try.
  EXPECT_TRUE(result.err.find("cannot write /proc") != std::string::npos ||
              result.err.find("folder /proc cannot be written") != std::string::npos)
      << result.err;
  const TempFolder folder;
  writeFile(folder / "results.json", toJson(SampleRun().results()));
  const ProcessResult page = runGlintmark({"report", folder.path(), "-o", "/proc/page.html"});
  EXPECT_EQ(page.exit_code, 2);
  EXPECT_NE(page.err.find("/proc/page.html"), std::string::npos) << page.err;
}

TEST(Faults, ANewerSchemaIsReadByNothingAndStaysAsItIs) {
  const TempFolder folder;
  std::string text = toJson(SampleRun().results());
  text.replace(text.find("glintmark.results/1"), 19, "glintmark.results/2");
  writeFile(folder / "results.json", text);
  const std::string file = folder / "results.json";
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"report", folder.path(), "-o", folder / "page.html"}, {"compare", file, file}}) {
    const ProcessResult result = runGlintmark(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments[0];
    EXPECT_NE(result.err.find("glintmark.results/2"), std::string::npos) << result.err;
  }
  EXPECT_EQ(readFile(file), text);
  EXPECT_EQ(folder.entryCount(), 1u);
}

// A picture that is missing, and one that is none.
TEST(Faults, PagesSayWhichPicturesTheyLack) {
  const TempFolder folder;
  writeFile(folder / "results.json", toJson(SampleRun().results()));
  writeFile(folder / "cells_snow_steep.png", "no picture");
  const ProcessResult result = runGlintmark({"report", folder.path(), "-o", folder / "page.html"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::string page = readFile(folder / "page.html");
  EXPECT_NE(page.find("cells_car_steep.png is not in the folder"), std::string::npos);
  EXPECT_NE(page.find("cannot read image"), std::string::npos);
}

}  // namespace
}  // namespace glintmark
