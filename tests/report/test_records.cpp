#include "host/report/record/records.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "tests/report/sample_records.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

void expectEqual(const Record& a, const Record& b) {
  EXPECT_EQ(a.table, b.table);
  EXPECT_EQ(a.case_, b.case_);
  EXPECT_EQ(a.metric, b.metric);
  EXPECT_EQ(a.unit, b.unit);
  EXPECT_EQ(a.value.n, b.value.n);
  EXPECT_EQ(a.value.min, b.value.min);
  EXPECT_EQ(a.value.median, b.value.median);
  EXPECT_EQ(a.value.p95, b.value.p95);
  EXPECT_EQ(a.value.stddev, b.value.stddev);
  EXPECT_EQ(a.paper, b.paper);
  EXPECT_EQ(a.valid, b.valid);
  EXPECT_EQ(a.note, b.note);
  EXPECT_EQ(a.config, b.config);
  EXPECT_EQ(a.timer, b.timer);
}

void expectEqual(const MachineState& a, const MachineState& b) {
  EXPECT_EQ(a.load, b.load);
  EXPECT_EQ(a.clock_mhz, b.clock_mhz);
  EXPECT_EQ(a.peak_gflops, b.peak_gflops);
  EXPECT_EQ(a.peak_gbs, b.peak_gbs);
}

Results sampleResults() {
  Results results{sampleRun(), {}};
  results.run.memory_bytes = 8ull << 30;
  results.run.begin = {0.5, 3000, 451.25, 20.5};
  results.run.end = {1.5, 2500, 400.5, 19.25};
  results.run.others_cores = 0.25;
  results.run.throttled_s = 0.125;
  results.run.busy = "why";
  results.records.push_back(sampleRecord("snow/steep", "shading_ms", 1.0 / 3));
  results.records.back().paper = 2.5;
  results.records.back().timer = "wall";
  results.records.push_back(sampleRecord("snow/grazing", "cells_mean", 24.75));
  results.records.back().valid = false;
  results.records.back().note = "a, b; \"c\"\nnew line, \xC3\xA9";
  return results;
}

TEST(Records, JsonRoundTripIsExact) {
  const Results results = sampleResults();
  const Results back = fromJson(toJson(results), "text");
  EXPECT_EQ(back.run.cpu, results.run.cpu);
  EXPECT_EQ(back.run.date, results.run.date);
  EXPECT_EQ(back.run.git, results.run.git);
  EXPECT_EQ(back.run.command, results.run.command);
  EXPECT_EQ(back.run.device, results.run.device);
  EXPECT_EQ(back.run.driver, results.run.driver);
  EXPECT_EQ(back.run.platform, results.run.platform);
  EXPECT_EQ(back.run.cores, results.run.cores);
  EXPECT_EQ(back.run.width, results.run.width);
  EXPECT_EQ(back.run.peak_gflops, results.run.peak_gflops);
  EXPECT_EQ(back.run.peak_gbs, results.run.peak_gbs);
  EXPECT_EQ(back.run.memory_bytes, results.run.memory_bytes);
  expectEqual(back.run.begin, results.run.begin);
  expectEqual(back.run.end, results.run.end);
  EXPECT_EQ(back.run.others_cores, results.run.others_cores);
  EXPECT_EQ(back.run.throttled_s, results.run.throttled_s);
  EXPECT_EQ(back.run.busy, results.run.busy);
  ASSERT_EQ(back.records.size(), results.records.size());
  for (std::size_t i = 0; i < back.records.size(); ++i) {
    expectEqual(back.records[i], results.records[i]);
  }
}

// Files of before there were machine states and timers, as those in results/ are.
TEST(Records, OlderFilesAreRead) {
  nlohmann::json json = nlohmann::json::parse(toJson(sampleResults()));
  json.erase("sum");
  for (const char* field : {"memory_bytes", "begin", "end", "others_cores", "throttled_s", "busy"})
    json["run"].erase(field);
  for (auto& record : json["records"]) record.erase("timer");
  const Results back = fromJson(json.dump(), "text");
  EXPECT_EQ(back.run.busy, "");
  EXPECT_EQ(back.run.end.peak_gflops, 0);
  EXPECT_EQ(back.records.at(0).timer, "");
}

// However another tool spells it: keys in other order, no blanks, whole numbers without a point.
TEST(Records, ChecksumIsOfWhatAFileHolds) {
  const std::string text = toJson(sampleResults());
  std::string spelt = nlohmann::json::parse(text).dump(4);
  ASSERT_NE(spelt.find("451.25,"), std::string::npos);
  spelt.replace(spelt.find("451.25,"), 7, "45125e-2,");
  expectEqual(fromJson(spelt, "text").records[1], sampleResults().records[1]);
}

// Of every byte every bit: refused, or the same figures.
TEST(Records, NoFlippedBitChangesAFigure) {
  const std::string whole = toJson(sampleResults());
  const std::string figures = toCsv(sampleResults().records);
  int refused = 0;
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = whole;
      damaged[i] = static_cast<char>(damaged[i] ^ 1 << bit);
      try {
        const Results read = fromJson(damaged, "text");
        EXPECT_EQ(toCsv(read.records), figures) << i << ' ' << bit;
        EXPECT_EQ(headerLine(read.run), headerLine(sampleResults().run)) << i << ' ' << bit;
      } catch (const Error&) {
        ++refused;
      }
    }
  EXPECT_GT(refused, static_cast<int>(whole.size()) * 4);
  std::string digit = whole;
  digit.replace(digit.find("24.75"), 5, "24.76");
  EXPECT_NE(messageOf<Error>([&] { fromJson(digit, "a.json"); }).find("a.json is damaged"),
            std::string::npos);
}

TEST(Records, LinesRoundTripAndHaveNoNewline) {
  const Results results = sampleResults();
  const std::string line = recordLine(results.records[1]);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  expectEqual(parseRecordLine(line, "line").record, results.records[1]);
  EXPECT_EQ(parseHeaderLine(headerLine(results.run), "line").device, "cpu-device");
}

TEST(Records, NotFiniteBecomesNullAndInvalid) {
  Results results{sampleRun(), {sampleRecord("a/b", "m", 1)}};
  results.records[0].value.median = std::nan("");
  const std::string text = toJson(results);
  EXPECT_NE(text.find("\"median\": null"), std::string::npos);
  const Results back = fromJson(text, "text");
  EXPECT_TRUE(std::isnan(back.records[0].value.median));
  EXPECT_FALSE(back.records[0].valid);
}

TEST(Records, BytesThatAreNotUtf8DoNotStopARun) {
  Results results{sampleRun(), {}};
  results.run.command = "glintmark render \xFF.toml";
  EXPECT_NO_THROW(fromJson(toJson(results), "text"));
}

TEST(Records, DamagedTextsAreNamed) {
  const std::string whole = toJson(sampleResults());
  const auto error = [](const std::string& text) {
    return messageOf<Error>([&] { fromJson(text, "old.json"); });
  };
  EXPECT_NE(error(whole.substr(0, whole.size() / 2)).find("old.json is not valid JSON"),
            std::string::npos);
  EXPECT_NE(error("").find("cut off"), std::string::npos);
  EXPECT_NE(error("{\"schema\":" + std::string(1000000, '[') + std::string(1000000, ']') + "}")
                .find("more brackets in brackets"),
            std::string::npos);
  EXPECT_NE(error("[]").find("no results schema"), std::string::npos);
  EXPECT_NE(error("{\"schema\":\"glintmark.results/2\"}").find("'glintmark.results/1'"),
            std::string::npos);
  EXPECT_NE(error("{\"schema\":\"glintmark.results/1\",\"run\":{}}").find("lacks a field"),
            std::string::npos);
}

TEST(Records, FilesRoundTripAndMissingFilesAreNamed) {
  const TempFolder folder;
  writeFile(folder / "results.json", toJson(sampleResults()));
  EXPECT_EQ(readResults(folder / "results.json").records.size(), 2u);
  EXPECT_NE(messageOf<Error>([&] { readResults(folder / "none.json"); }).find("none.json"),
            std::string::npos);
  EXPECT_THROW(readResults(folder.path()), Error);
}

TEST(Records, CsvQuotesAndCounts) {
  const std::string csv = toCsv(sampleResults().records);
  EXPECT_NE(csv.find("zk16,snow/steep,shading_ms,ms,0.3333333333333333,"), std::string::npos)
      << csv;
  EXPECT_TRUE(
      csv.starts_with("table,case,metric,unit,median,min,p95,stddev,n,paper,valid,note,timer,"
                      "config.method,config.size"))
      << csv;
  EXPECT_NE(csv.find(",5,2.5,true,,wall,zk16,1920x1080"), std::string::npos) << csv;
  EXPECT_NE(csv.find(",5,,false,\"a, b; \"\"c\"\"\nnew line"), std::string::npos) << csv;
}

}  // namespace
}  // namespace glintmark
