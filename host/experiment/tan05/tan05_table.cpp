#include "host/experiment/tan05/tan05_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

struct PaperFigure {
  std::string_view case_name;
  double value;
};
constexpr std::array kPaperErrors = {
    PaperFigure{"disk/far/gmm", 0.060},     PaperFigure{"disk/far/toksvig", 0.165},
    PaperFigure{"disk/oblique/gmm", 0.041}, PaperFigure{"disk/oblique/fournier", 0.123},
    PaperFigure{"armour/far/gmm", 0.058},   PaperFigure{"armour/far/fixed", 0.175}};
constexpr std::array kPaperFps = {
    PaperFigure{"disk/far/gmm", 120},     PaperFigure{"disk/far/toksvig", 125},
    PaperFigure{"disk/oblique/gmm", 120}, PaperFigure{"disk/oblique/fournier", 13},
    PaperFigure{"armour/far/gmm", 107},   PaperFigure{"desert/far/gmm", 45}};

std::optional<double> figureOf(std::span<const PaperFigure> figures, std::string_view case_name) {
  const auto found = std::ranges::find(figures, case_name, &PaperFigure::case_name);
  return found == figures.end() ? std::nullopt : std::optional(found->value);
}

std::string paperText(const CaseRecords& one, const char* metric, const char* format) {
  const Record* record = one.find(metric);
  return record == nullptr || !record->paper ? "-"
                                             : fmt::format(fmt::runtime(format), *record->paper);
}

struct SummaryRow {
  const char* metric;
  const char* what;
  const char* paper;
};
constexpr SummaryRow kSummary[] = {
    {"gmm_over_toksvig", "four lobes over Toksvig, time", "1.04"},
    {"fournier_over_gmm", "Fournier over four lobes, time", "9.2"},
    {"speedup_vs_w1", "four lobes over one lane", "-"},
    {"bytes_per_px", "texel bytes read per pixel, four lobes", "-"},
    {"half_over_float", "half-precision texels over single, time", "-"},
    {"fit_ms", "fit of a 512x512 map, four lobes, ms", "300000"}};

}  // namespace

std::optional<double> tan05PaperError(std::string_view case_name) {
  return figureOf(kPaperErrors, case_name);
}

std::optional<double> tan05PaperFps(std::string_view case_name) {
  return figureOf(kPaperFps, case_name);
}

std::string tan05TableText(std::span<const Record> records) {
  TextTable table(
      {"case", "ms", "fps", "paper fps", "error", "paper", "frame to frame", "truth s.e."});
  std::string last_view;
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    if (one.find("frame_to_frame_error") == nullptr) continue;
    const std::string view = name.substr(0, name.rfind('/'));
    if (!last_view.empty() && view != last_view) table.addRule();
    last_view = view;
    table.addRow({name, one.text("shading_ms"), one.text("fps"), paperText(one, "fps", "{:.0f}"),
                  one.text("colour_error"), paperText(one, "colour_error", "{:.3f}"),
                  one.text("frame_to_frame_error"), one.text("truth_stderr")});
  }
  return table.toString();
}

std::string tan05DistanceText(std::span<const Record> records) {
  std::vector<std::string> methods, views;
  const auto add = [](std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const std::string& name : caseNames(records)) {
    if (name.find("/near_") == std::string::npos) continue;
    add(methods, name.substr(name.rfind('/') + 1));
    add(views, name.substr(0, name.rfind('/')));
  }
  if (views.empty()) return "";
  std::vector<std::string> header = {"error over distance"};
  header.insert(header.end(), methods.begin(), methods.end());
  header.push_back("truth s.e.");
  TextTable table(header);
  for (const std::string& view : views) {
    std::vector<std::string> row = {view};
    for (const std::string& method : methods)
      row.push_back(CaseRecords(records, view + "/" + method).text("colour_error"));
    row.push_back(CaseRecords(records, view + "/" + methods.front()).text("truth_stderr"));
    table.addRow(row);
  }
  return table.toString();
}

std::string tan05SummaryText(std::span<const Record> records) {
  const CaseRecords all(records, "all");
  if (all.find("gmm_over_toksvig") == nullptr) return "";
  TextTable table({"over all", "ours", "paper"});
  for (const SummaryRow& row : kSummary)
    if (all.find(row.metric) != nullptr) table.addRow({row.what, all.text(row.metric), row.paper});
  TextTable knobs({"knob", "ms", "bytes/px", "error"});
  for (const std::string& name : caseNames(records)) {
    if (name.find('=') == std::string::npos) continue;
    const CaseRecords one(records, name);
    knobs.addRow(
        {name, one.text("shading_ms"), one.text("bytes_per_px"), one.text("colour_error")});
  }
  return table.toString() + "\n" + knobs.toString();
}

}  // namespace glintmark
