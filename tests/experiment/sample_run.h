// A run with every table, as the benchmarks write them, in small.
#pragma once
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "host/experiment/accuracy/accuracy_table.h"
#include "host/report/record/records.h"
#include "tests/report/sample_records.h"

namespace glintmark {

class SampleRun {
 public:
  SampleRun() {
    addZk16();
    addPapers();
    addEffects();
    addAccuracy();
    add("some_new_table", "a <b> & \"c\"", "things_ms", "ms", 3);
  }
  const Results& results() const { return results_; }

  void add(const std::string& table, const std::string& case_name, const std::string& metric,
           const std::string& unit, double value, std::optional<double> paper = {}) {
    Record record = sampleRecord(case_name, metric, value);
    record.table = table;
    record.unit = unit;
    record.paper = paper;
    results_.records.push_back(record);
  }

 private:
  void addZk16() {
    for (const char* name : {"snow/steep", "snow/grazing", "car/steep"}) {
      add("zk16", name, "shading_ms", "ms", 42.7, 2.5);
      add("zk16", name, "frame_without_ms", "ms", 15.8);
      add("zk16", name, "raster_ms", "ms", 20.8);
      add("zk16", name, "upload_ms", "ms", 0.07);
      add("zk16", name, "readback_ms", "ms", 11);
      add("zk16", name, "normalised_cost", "1", 0.909);
      add("zk16", name, "ns_per_cell", "ns", 2.57);
      add("zk16", name, "cells_mean", "cells", 12);
    }
  }

  void addPapers() {
    for (const char* method : {"original", "tao21", "exact"}) {
      const std::string name = std::string("area_cloth/near/") + method;
      add("tao21", name, "shading_ms", "ms", 131, 16);
      add("tao21", name, "rel_mse", "1", 0.28);
      add("tao21", name, "truth_stderr", "1", 0.05);
    }
    for (const char* lights : {"1", "2", "4", "8"})
      add("tao21", std::string("area_plane/lights=") + lights, "shading_ms", "ms", 25);
    for (const char* method : {"gmm", "toksvig"}) {
      const std::string name = std::string("disk/far/") + method;
      add("tan05", name, "shading_ms", "ms", 9);
      add("tan05", name, "fps", "1/s", 110, 120);
      add("tan05", name, "colour_error", "1", 0.019, 0.06);
    }
    for (const char* alpha : {"0.2", "0.5", "0.8"})
      for (const char* order : {"order_1", "order_2", "order_3"})
        add("msbrdf", std::string("surface/alpha=") + alpha, order, "1", 0.4);
    add("msbrdf", "all", "simulate_500m_ms", "ms", 63000, 500);
  }

  void addEffects() {
    const std::vector<std::string> sets = {"none",           "glints",     "normals",     "ltc",
                                           "glints+normals", "glints+ltc", "normals+ltc", "all"};
    for (const std::string& set : sets) {
      add("effects", set, "shading_ms", "ms", 60);
      add("effects", set, "uber_over_specialised", "1", 2.4);
      add("effects", set, "planes_bytes", "bytes", 40e6);
      add("effects", set, "tables_bytes", "bytes", 3e6);
      add("effects", set, "build_ms", "ms", 90);
      if (set.find('+') != std::string::npos || set == "all")
        add("effects", set, "mixed_over_sum", "1", 1.02);
    }
  }

  void addAccuracy() {
    for (const char* effect : {"glints", "ltc"})
      for (int step = 0; step < 5; ++step) {
        addSetting(std::string(effect) + "/ka=" + std::to_string(1 << step),
                   0.5 * std::pow(1.6, step), 0.2 * std::pow(0.5, step),
                   step == 2 ? kAccuracyDefault : kAccuracyKnob);
        addSetting(std::string(effect) + "/mc_samples=" + std::to_string(1 << step),
                   std::pow(2.5, step), 0.4 * std::pow(0.6, step), kAccuracyRival);
      }
    addSetting("glints/grids=2", 1.28, 0.05, kAccuracyDefault);
  }

  // Rivals are not optimal, all others are.
  void addSetting(const std::string& name, double time_ratio, double error, const char* role) {
    const std::size_t first = results_.records.size();
    add("accuracy", name, "error", "1", error);
    add("accuracy", name, "truth_stderr", "1", 0.004);
    add("accuracy", name, "time_ratio", "1", time_ratio);
    add("accuracy", name, "pareto", "1", role == std::string(kAccuracyRival) ? 0 : 1);
    for (std::size_t i = first; i < results_.records.size(); ++i)
      results_.records[i].config["role"] = role;
  }

  Results results_ = {sampleRun(), {}};
};

}  // namespace glintmark
