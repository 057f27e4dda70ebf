#include "host/report/zk16_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/text_table.h"

namespace glintmark {
namespace {

// The records of one case, by metric.
class CaseRecords {
 public:
  CaseRecords(std::span<const Record> records, const std::string& name)
      : records_(records), name_(name) {}

  const Record* find(std::string_view metric) const {
    const auto found = std::ranges::find_if(records_, [&](const Record& record) {
      return record.case_ == name_ && record.metric == metric;
    });
    return found == records_.end() ? nullptr : &*found;
  }
  /// The median as a short number, "-" if it was not measured, with "!" if it is not valid.
  std::string text(std::string_view metric) const {
    const Record* record = find(metric);
    if (record == nullptr) return "-";
    return compactNumber(record->value.median) + (record->valid ? "" : "!");
  }
  /// The same without digits after the point.
  std::string count(std::string_view metric) const {
    const Record* record = find(metric);
    return record == nullptr ? "-" : fmt::format("{:.0f}", record->value.median);
  }

 private:
  std::span<const Record> records_;
  std::string name_;
};

std::vector<std::string> caseNames(std::span<const Record> records) {
  std::vector<std::string> names;
  for (const Record& record : records) {
    if (std::ranges::find(names, record.case_) == names.end()) names.push_back(record.case_);
  }
  return names;
}

}  // namespace

std::optional<double> zk16PaperMs(std::string_view scene, std::string_view view) {
  const auto row = std::ranges::find(kZk16Table1, scene, &Zk16PaperRow::scene);
  if (row == kZk16Table1.end()) return std::nullopt;
  if (view == kZk16Views[0]) return row->steep_ms;
  if (view == kZk16Views[1]) return row->grazing_ms;
  return std::nullopt;
}

double normalisedCost(double ours_ms, double our_peak_gflops, double paper_ms) {
  return ours_ms * our_peak_gflops / (paper_ms * kGtx980PeakGflops);
}

std::string zk16TableText(std::span<const Record> records) {
  TextTable table({"scene", "triangles", "view", "paper ms", "ours ms", "ratio", "norm.cost",
                   "cells min/mean/max", "ns/cell", "xW1"});
  std::string last_scene;
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    const std::size_t slash = name.find('/');
    const std::string scene = name.substr(0, slash);
    const Record* shading = one.find("shading_ms");
    const bool has_paper = shading != nullptr && shading->paper.has_value();
    table.addRow({scene == last_scene ? "" : scene,
                  scene == last_scene ? "" : one.count("triangles"),
                  slash == std::string::npos ? "" : name.substr(slash + 1),
                  has_paper ? fmt::format("{:.1f}", *shading->paper) : "-", one.text("shading_ms"),
                  has_paper ? compactNumber(shading->value.median / *shading->paper) : "-",
                  one.text("normalised_cost"),
                  fmt::format("{}/{}/{}", one.count("cells_min"), one.text("cells_mean"),
                              one.count("cells_max")),
                  one.text("ns_per_cell"), one.text("speedup_vs_w1")});
    last_scene = scene;
  }
  return table.toString();
}

std::string zk16BreakdownText(std::span<const Record> records) {
  TextTable table({"case (ms)", "raster", "upload", "frame+", "frame-", "event", "readback",
                   "build", "1st enq", "px", "B/px", "guard"});
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    table.addRow({name, one.text("raster_ms"), one.text("upload_ms"), one.text("frame_with_ms"),
                  one.text("frame_without_ms"), one.text("shading_event_ms"),
                  one.text("readback_ms"), one.text("build_ms"), one.text("first_enqueue_ms"),
                  one.text("covered_px"), one.text("buffer_bytes_per_px"), one.text("guard_hits")});
  }
  return table.toString();
}

}  // namespace glintmark
