#include "host/report/record/record_log.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/report/record/records.h"
#include "tests/report/sample_records.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

void appendOne(RecordLog& log, const Record& record) {
  log.append({&record, 1});
}

TEST(RecordLog, EveryRecordIsOnDiskAtOnce) {
  const TempFolder folder;
  RecordLog log = RecordLog::create(folder / "a.jsonl", sampleRun());
  appendOne(log, sampleRecord("a/b", "m", 1));
  // The log is still open; another reader sees two whole lines.
  const std::string text = readFile(folder / "a.jsonl");
  EXPECT_EQ(std::ranges::count(text, '\n'), 2);
  EXPECT_TRUE(text.ends_with('\n'));
}

TEST(RecordLog, ResumeFindsByConfiguration) {
  const TempFolder folder;
  {
    RecordLog log = RecordLog::create(folder / "a.jsonl", sampleRun());
    appendOne(log, sampleRecord("a/b", "m", 1));
    appendOne(log, sampleRecord("a/b", "other", 7));
    appendOne(log, sampleRecord("a/b", "m", 2));
  }
  const RecordLog log = RecordLog::resume(folder / "a.jsonl", sampleRun());
  ASSERT_EQ(log.records().size(), 3u);
  const auto find = [&](const std::string& name, const std::map<std::string, std::string>& config) {
    return log.recordsOf("zk16", name, config);
  };
  const std::vector<Record> found = find("a/b", {{"size", "1920x1080"}});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].metric, "m");
  EXPECT_EQ(found[0].value.median, 2);  // the later one
  EXPECT_EQ(found[1].metric, "other");
  EXPECT_TRUE(find("a/b", {{"size", "64x36"}}).empty());
  EXPECT_TRUE(find("a/b", {{"size", "1920x1080"}, {"set", "x=1"}}).empty());
  EXPECT_TRUE(find("a/c", {}).empty());
  EXPECT_TRUE(log.recordsOf("tan05", "a/b", {}).empty());
}

TEST(RecordLog, CutOffLastLineIsDropped) {
  const TempFolder folder;
  {
    RecordLog log = RecordLog::create(folder / "a.jsonl", sampleRun());
    appendOne(log, sampleRecord("a/b", "m", 1));
  }
  std::ofstream(folder / "a.jsonl", std::ios::app) << R"({"table":"zk16","case":"a/)";
  {
    RecordLog log = RecordLog::resume(folder / "a.jsonl", sampleRun());
    EXPECT_EQ(log.records().size(), 1u);
    appendOne(log, sampleRecord("a/c", "m", 3));
  }
  const RecordLog log = RecordLog::resume(folder / "a.jsonl", sampleRun());
  ASSERT_EQ(log.records().size(), 2u);
  EXPECT_EQ(log.records()[1].case_, "a/c");
}

// Cut off at each of its bytes, as a kill may do it: whole batches remain, no part of one.
TEST(RecordLog, CutAnywhereABatchIsThereWholeOrNotAtAll) {
  const TempFolder folder;
  const std::vector<Record> first = {sampleRecord("a/b", "m", 1), sampleRecord("a/b", "n", 2)};
  const std::vector<Record> second = {sampleRecord("a/c", "m", 3), sampleRecord("a/c", "n", 4),
                                      sampleRecord("a/c", "o", 5)};
  std::vector<std::size_t> ends;
  {
    RecordLog log = RecordLog::create(folder / "a.jsonl", sampleRun());
    log.append(first);
    ends.push_back(readFile(folder / "a.jsonl").size());
    log.append(second);
    ends.push_back(readFile(folder / "a.jsonl").size());
  }
  const std::string whole = readFile(folder / "a.jsonl");
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    const std::string text = whole.substr(0, size);
    const std::size_t expected = size < ends[0] ? 0 : size < ends[1] ? 2 : 5;
    EXPECT_EQ(parseLog(text, "log").records.size(), expected) << size;
    if (size % 97 != 0) continue;  // what is appended afterwards, at some of them
    writeFile(folder / "cut.jsonl", text);
    {
      RecordLog log = RecordLog::resume(folder / "cut.jsonl", sampleRun());
      ASSERT_EQ(log.records().size(), expected);
      if (expected < 2) log.append(first);
      if (expected < 5) log.append(second);
    }
    EXPECT_EQ(readFile(folder / "cut.jsonl"), whole) << size;
  }
}

TEST(RecordLog, DamageBeforeTheLastLineIsAnError) {
  const TempFolder folder;
  writeFile(folder / "a.jsonl", headerLine(sampleRun()) + "\n{\"table\":\n" +
                                    recordLine(sampleRecord("a/b", "m", 1)) + "\n");
  const std::string message =
      messageOf<Error>([&] { RecordLog::resume(folder / "a.jsonl", sampleRun()); });
  EXPECT_NE(message.find("a.jsonl line 2"), std::string::npos) << message;
}

// Whatever byte flips, no figure is another's: the line is refused, or read as it was.
TEST(RecordLog, FlippedBytesAreFound) {
  const TempFolder folder;
  {
    RecordLog log = RecordLog::create(folder / "a.jsonl", sampleRun());
    appendOne(log, sampleRecord("a/b", "m", 1.25));
    appendOne(log, sampleRecord("a/c", "m", 3));
  }
  const std::string whole = readFile(folder / "a.jsonl");
  const LogContent wanted = parseLog(whole, "log");
  std::size_t refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int bit : {1, 2, 16}) {
      std::string text = whole;
      text[i] = static_cast<char>(text[i] ^ bit);
      try {
        const LogContent content = parseLog(text, "log");
        ASSERT_LE(content.records.size(), 2u);
        for (std::size_t r = 0; r < content.records.size(); ++r)
          EXPECT_EQ(recordLine(content.records[r]), recordLine(wanted.records[r])) << i;
      } catch (const Error&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 3 * whole.size() * 9 / 10);
}

TEST(RecordLog, LogsOfEarlierVersionsHaveNoChecksums) {
  const std::string text =
      headerLine(sampleRun()) + "\n" + recordLine(sampleRecord("a/b", "m", 1)) + "\n";
  EXPECT_EQ(parseLog(text, "log").records.size(), 1u);
  const std::string mixed =
      withChecksum(headerLine(sampleRun())) + "\n" + recordLine(sampleRecord("a/b", "m", 1)) + "\n";
  EXPECT_NE(messageOf<Error>([&] { parseLog(mixed, "log"); }).find("line 2"), std::string::npos);
}

TEST(RecordLog, PipesAndLinksAreRefusedAtOnce) {
  const TempFolder folder;
  ASSERT_EQ(mkfifo((folder / "pipe.jsonl").c_str(), 0600), 0);
  writeFile(folder / "target", "kept");
  std::filesystem::create_symlink(folder / "target", folder / "link.jsonl");
  std::filesystem::create_symlink(folder / "nowhere", folder / "dangling.jsonl");
  for (const bool resume : {false, true}) {
    const auto open = [&](const char* name) {
      return resume ? RecordLog::resume(folder / name, sampleRun())
                    : RecordLog::create(folder / name, sampleRun());
    };
    EXPECT_THROW(open("pipe.jsonl"), Error) << resume;
    EXPECT_THROW(open("dangling.jsonl"), Error) << resume;
  }
  { RecordLog::create(folder / "link.jsonl", sampleRun()); }
  EXPECT_EQ(readFile(folder / "target"), "kept");
  EXPECT_FALSE(std::filesystem::exists(folder / "nowhere"));
}

TEST(RecordLog, OtherSetupsAreRefused) {
  const TempFolder folder;
  { RecordLog::create(folder / "a.jsonl", sampleRun()); }
  const auto refusal = [&](const RunInfo& run) {
    return messageOf<Error>([&] { RecordLog::resume(folder / "a.jsonl", run); });
  };
  RunInfo run = sampleRun();
  run.device = "another device";
  EXPECT_NE(refusal(run).find("device 'cpu-device', not 'another device'"), std::string::npos);
  run = sampleRun();
  run.width = 8;
  EXPECT_NE(refusal(run).find("width"), std::string::npos);
  run = sampleRun();
  run.driver = "other";
  EXPECT_NE(refusal(run).find("driver"), std::string::npos);
  run = sampleRun();
  run.inputs = "0123";
  EXPECT_NE(refusal(run).find("kernels, tables, scenes and meshes"), std::string::npos);
  run = sampleRun();
  run.git = "other";
  EXPECT_NE(refusal(run).find("program version"), std::string::npos);
  writeFile(folder / "a.jsonl", "{\"schema\":\"glintmark.results/9\",\"run\":{}}\n");
  EXPECT_NE(refusal(sampleRun()).find("glintmark.results/9"), std::string::npos);
}

TEST(RecordLog, MissingOrEmptyLogStartsAfresh) {
  const TempFolder folder;
  EXPECT_TRUE(RecordLog::resume(folder / "none.jsonl", sampleRun()).records().empty());
  writeFile(folder / "cut.jsonl", "{\"schema\":\"glint");
  EXPECT_TRUE(RecordLog::resume(folder / "cut.jsonl", sampleRun()).records().empty());
  EXPECT_EQ(readFile(folder / "cut.jsonl"), withChecksum(headerLine(sampleRun())) + "\n");
}

TEST(RecordLog, CreateKeepsAnOldLogUnderAnotherName) {
  const TempFolder folder;
  writeFile(folder / "a.jsonl", "old");
  { RecordLog::create(folder / "a.jsonl", sampleRun()); }
  EXPECT_EQ(readFile(folder / "a.jsonl"), withChecksum(headerLine(sampleRun())) + "\n");
  EXPECT_EQ(readFile(folder / "a.jsonl.old"), "old");
}

TEST(RecordLog, FullDiskIsAnError) {
  EXPECT_THROW(RecordLog::create("/dev/full", sampleRun()), Error);
}

TEST(RecordLog, UnwritablePathIsAnError) {
  const TempFolder folder;
  EXPECT_THROW(RecordLog::create(folder / "none/a.jsonl", sampleRun()), Error);
}

}  // namespace
}  // namespace glintmark
