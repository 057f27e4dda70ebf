#include "host/experiment/tan05/tan05_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "host/experiment/summary_table.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

struct PaperFigure {
  std::string_view case_name;
  double value;
};
// Of the paper's own maps, which were not published; its filter is one trilinear lookup a pixel.
constexpr std::array kPaperErrors = {
    PaperFigure{"disk/far/one_row", 0.060},     PaperFigure{"disk/far/toksvig", 0.165},
    PaperFigure{"disk/oblique/one_row", 0.041}, PaperFigure{"disk/oblique/peaks_4", 0.123},
    PaperFigure{"armour/far/one_row", 0.058},   PaperFigure{"armour/far/fixed", 0.175}};
constexpr std::array kPaperFps = {
    PaperFigure{"disk/far/one_row", 120},     PaperFigure{"disk/far/toksvig", 125},
    PaperFigure{"disk/oblique/one_row", 120}, PaperFigure{"disk/oblique/peaks_4", 13},
    PaperFigure{"armour/far/one_row", 107},   PaperFigure{"desert/far/one_row", 45}};

std::optional<double> figureOf(std::span<const PaperFigure> figures, std::string_view case_name) {
  const auto found = std::ranges::find(figures, case_name, &PaperFigure::case_name);
  return found == figures.end() ? std::nullopt : std::optional(found->value);
}

std::string paperText(const CaseRecords& one, const char* metric, const char* format) {
  const Record* record = one.find(metric);
  return record == nullptr || !record->paper ? "-"
                                             : fmt::format(fmt::runtime(format), *record->paper);
}

constexpr SummaryRow kSummary[] = {
    {"gmm_over_toksvig", "four lobes over Toksvig, time", "1.04"},
    {"fournier_over_gmm", "Fournier over four lobes, time", "9.2"},
    {"speedup_vs_w1", "four lobes over one lane", "-"},
    {"bytes_per_px", "texel bytes read per pixel, four lobes", "-"},
    {"half_over_float", "half-precision texels over single, time", "-"},
    {"fit_ms", "fit of a 512x512 map, four lobes, ms", "300000"}};

// "disk/near" of "disk/near/gmm".
CaseName viewOf(CaseName name) {
  if (!name.words.empty()) name.words.pop_back();
  return name;
}

// The case of a method in a view, "disk/near".
std::string tan05Case(const std::string& view, const std::string& method) {
  CaseName name = CaseName::parse(view);
  name.words.push_back(method);
  return name.text();
}

}  // namespace

const TableSpec& tan05Spec() {
  static const TableSpec spec = {
      .name = "tan05",
      .title = "Normal filtering",
      .about = "Mixtures of Gaussians against the other ways to filter a normal map.",
      .source = "Tan et al. 2005: GeForce 6800 GT, 500×500",
      .citation = "[TAN05]",
      .metrics =
          {{"shading_ms", "ms", "shading time",
            "kernel events of the frame, at 500×500 with all methods in turn; of knobs at the "
            "command line's size",
            "`scene/view/method`, `disk/oblique/lobes=N`, `disk/oblique/anisotropy=N`"},
           {"fps", "1/s", "frames per second at 500×500",
            "1000 / `shading_ms`; the paper's beside it where it has one", "`scene/view/method`"},
           {"frame_to_frame_error", "1", "frame-to-frame error",
            "colour error of the change from frame to frame, four frames of a zoom-out by 1.02 "
            "each, "
            "against the truth's change"},
           {"colour_error", "1", "colour error",
            "distance of display colours from the ground truth over the covered pixels: 64 samples "
            "a pixel at 500×500; at a distance 256 at 250×250, mean over four shifts of the camera "
            "by "
            "parts of a pixel",
            "all but `all`"},
           {"bias", "1", "bias", "mean radiance over the truth's, less 1",
            "`scene/view/method`, `scene/near_D/method`"},
           {"rel_mse", "1", "relMSE", "relative mean square error of radiance"},
           {"truth_stderr", "1", "standard error of the truth", "of the truth, as a colour error"},
           {"bytes_per_px", "bytes", "bytes read per pixel",
            "texels that the fetch reads, mean over the covered pixels; in case `all` of four "
            "lobes",
            "`disk/oblique/lobes=N`, `disk/oblique/anisotropy=N`, `all`"},
           {"gmm_over_toksvig", "1", "mixtures over Toksvig, time",
            "time ratios in turn, `disk/near` at the command line's size, one row of probes",
            "`all`"},
           {"fournier_over_gmm", "1", "Fournier over mixtures, time"},
           {"speedup_vs_w1", "1", "speed-up over one lane",
            "kernel events at one lane over all lanes, in turn"},
           {"half_over_float", "1", "",
            "texels in half precision over single precision, time, in turn"},
           {"fit_ms", "ms", "fit", "mixtures of a 512×512 map, four lobes, not from the cache"}},
      .cost_ratios = {"gmm_over_toksvig"},
      .headline = Headline{"gmm_over_toksvig", "times Toksvig's time for mixtures of normals"},
      .score = "shading_ms",
      .curves = {{"shading_ms"}},
      // Distances of the zoom-out are measured without a picture each.
      .pictures = {{.kind = PictureGroup::Kind::kStrips,
                    .heading = "Side by side",
                    .text = "Choose two pictures and move the slider.",
                    .truth_first = true,
                    .differences = true,
                    .optional = true}},
  };
  return spec;
}

std::string tan05DistanceView(double factor) {
  return fmt::format("{}_{}", kTan05DistanceBase, factor);
}

std::optional<double> tan05DistanceOf(std::string_view view) {
  for (const double factor : kTan05Distances)
    if (view == tan05DistanceView(factor)) return factor;
  return std::nullopt;
}

std::optional<double> tan05PaperError(std::string_view case_name) {
  return figureOf(kPaperErrors, case_name);
}

std::optional<double> tan05PaperFps(std::string_view case_name) {
  return figureOf(kPaperFps, case_name);
}

std::string tan05TableText(std::span<const Record> records) {
  TextTable table(
      {"case", "ms", "fps", "paper fps", "error", "paper", "bias", "relMSE", "step", "truth s.e."});
  std::string last_view;
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    if (one.find("frame_to_frame_error") == nullptr) continue;
    const CaseName parts = CaseName::parse(name);
    const std::string view = viewOf(parts).text();
    if (!last_view.empty() && view != last_view) table.addRule();
    last_view = view;
    table.addRow({name, one.text("shading_ms"), one.text("fps"), paperText(one, "fps", "{:.0f}"),
                  one.text("colour_error"), paperText(one, "colour_error", "{:.3f}"),
                  one.text("bias"), one.text("rel_mse"), one.text("frame_to_frame_error"),
                  one.text("truth_stderr")});
  }
  return table.toString() +
         "step: error of the change from frame to frame. The paper's errors are of its own maps, "
         "which\n"
         "were not published.\n";
}

std::string tan05DistanceText(std::span<const Record> records) {
  std::vector<std::string> methods, views;
  const auto add = [](std::vector<std::string>& names, const std::string& name) {
    if (std::ranges::find(names, name) == names.end()) names.push_back(name);
  };
  for (const std::string& name : caseNames(records)) {
    const CaseName parts = CaseName::parse(name);
    if (!tan05DistanceOf(parts.word(1))) continue;
    add(methods, parts.word(2));
    add(views, viewOf(parts).text());
  }
  if (views.empty()) return "";
  std::vector<std::string> header = {"error at"};
  header.insert(header.end(), methods.begin(), methods.end());
  header.push_back("s.e.");
  TextTable table(header);
  for (const std::string& view : views) {
    std::vector<std::string> row = {view};
    for (const std::string& method : methods)
      row.push_back(CaseRecords(records, tan05Case(view, method)).text("colour_error"));
    row.push_back(CaseRecords(records, tan05Case(view, methods.front())).text("truth_stderr"));
    table.addRow(row);
  }
  return table.toString();
}

std::string tan05SummaryText(std::span<const Record> records) {
  if (CaseRecords(records, kAllCase).find("gmm_over_toksvig") == nullptr) return "";
  TextTable knobs({"knob", "ms", "bytes/px", "error"});
  for (const std::string& name : caseNames(records)) {
    if (CaseName::parse(name).knobs.empty()) continue;
    const CaseRecords one(records, name);
    knobs.addRow(
        {name, one.text("shading_ms"), one.text("bytes_per_px"), one.text("colour_error")});
  }
  return summaryText(kSummary, records) + "\n" + knobs.toString();
}

}  // namespace glintmark
