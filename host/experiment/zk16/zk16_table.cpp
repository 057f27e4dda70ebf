#include "host/experiment/zk16/zk16_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
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
