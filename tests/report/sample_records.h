// Records to test with.
#pragma once
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

inline Record sampleRecord(const std::string& case_name, const std::string& metric, double value) {
  Record record;
  record.table = "zk16";
  record.case_ = case_name;
  record.metric = metric;
  record.unit = "ms";
  record.value = {.n = 5, .min = value * 0.9, .median = value, .p95 = value * 1.2, .stddev = 0.125};
  record.config = {{"size", "1920x1080"}, {"method", "zk16"}};
  return record;
}

inline RunInfo sampleRun() {
  RunInfo run;
  run.date = "2024-05-06T07:08:09Z";
  run.git = "abc1234";
  run.command = "glintmark bench zk16";
  run.cpu = "Some \"quoted\" processor";
  run.device = "cpu-device";
  run.driver = "3.1";
  run.platform = "Portable";
  run.cores = 2;
  run.width = 16;
  run.peak_gflops = 451.25;
  run.peak_gbs = 20.5;
  return run;
}

}  // namespace glintmark
