#include "host/experiment/tao21/tao21_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/experiment/summary_table.h"
#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

constexpr SummaryRow kSummary[] = {
    {"multiscale_over_original", "multi-scale over original, time", "1.00"},
    {"tao21_over_original", "the paper's polynomials over original, time", "1.00"},
    {"normalised_cost", "one quad, full screen, per FLOP over the paper's frame", "1"},
    {"plane_ms", "the same in ms, beside the paper's frame", "16"},
    {"speedup_vs_w1", "the same over one lane", "-"},
    {"mc_spp_at_equal_error", "Monte Carlo samples a pixel at the same error", "-"},
    {"mc_time_at_equal_error_over_ltc", "their time over that of the cosines", "-"},
    {"fit_ms", "fit of a table of 64 x 64, ms", "-"}};

}  // namespace

const TableSpec& tao21Spec() {
  static const TableSpec spec = {
      .name = "tao21",
      .title = "Area lights",
      .about = "Multi-scale linearly transformed cosines beside the original ones and Monte Carlo.",
      .source = "Tao et al. 2021, Figs. 5 to 7: GeForce GTX 1070, 1920×1080",
      .citation = "[TAO21]",
      .metrics =
          {{"shading_ms",
            "ms",
            "shading time",
            "kernel events of the frame, the methods of a view in turn; the paper has 16 for both",
            "`scene/view/method`, `area_plane/lights=N`, `area_plane/vertices=N`, "
            "`area_plane/shape=S`",
            {"rel_mse", "colour_error", "bias", "truth_stderr"}},
           {"rel_mse", "1", "relMSE",
            "against the ground truth: relative mean squared error, distance of display colours, "
            "mean radiance over the truth's − 1",
            "`scene/view/method`"},
           {"colour_error", "1", "colour error"},
           {"bias", "1", "bias of the mean"},
           {"truth_stderr", "1", "standard error of the truth",
            "what the truth itself may be off, as a relMSE; of older runs the mean over pixels "
            "over "
            "the mean radiance",
            "`scene/view/method`"},
           {"multiscale_over_original", "1", "multi-scale over original, time",
            "method `exact` over `original`, `area_knot/near`, in turn", "`all`"},
           {"tao21_over_original", "1", "the paper's polynomials over original, time",
            "method `tao21` over `original`, the same"},
           {"plane_ms", "ms", "one quad, full screen", "kernel events of `area_plane/front`"},
           {"normalised_cost", "1", "cost per FLOP over the paper's",
            "(`plane_ms` × peak of this device) / (16 ms × 6460 GFLOP/s, the GTX 1070's boost "
            "peak)"},
           {"speedup_vs_w1", "1", "speed-up over one lane",
            "kernel events of `area_plane/front` at one lane over all lanes, in turn"},
           {"mc_spp_at_equal_error", "1", "Monte Carlo samples at equal error",
            "samples a pixel by which Monte Carlo has the error of `exact`, `area_knot/middle`"},
           {"mc_time_at_equal_error_over_ltc", "1", "Monte Carlo over ours at equal error, time",
            "their time over that of `exact`"},
           {"fit_ms", "ms", "fit", "a table of 64 × 64, from a smaller one"}},
      .cost_ratios = {"multiscale_over_original", "tao21_over_original"},
      .headline = Headline{"multiscale_over_original",
                           "times the original's time for multi-scale area lights"},
      .score = "shading_ms",
      .curves = {{"shading_ms"}},
      .pictures = {{.kind = PictureGroup::Kind::kStrips,
                    .heading = "Side by side",
                    .text = "Choose two pictures and move the slider."}},
  };
  return spec;
}

std::string tao21TableText(std::span<const Record> records) {
  TextTable table({"case", "ms", "relMSE", "colour err", "bias", "truth s.e."});
  bool has_views = false;
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    if (one.find("rel_mse") == nullptr) continue;
    has_views = true;
    table.addRow({name, one.text("shading_ms"), one.text("rel_mse"), one.text("colour_error"),
                  one.text("bias"), one.text("truth_stderr")});
  }
  return has_views ? table.toString() + "\n" : "";
}

std::string tao21SummaryText(std::span<const Record> records) {
  TextTable curve({kTao21SummaryScene, "ms"});
  bool has_curve = false;
  for (const std::string& name : caseNames(records)) {
    const CaseName parts = CaseName::parse(name);
    if (parts.word(0) != kTao21SummaryScene || parts.knobs.empty()) continue;
    curve.addRow({parts.rest().text(), CaseRecords(records, name).text("shading_ms")});
    has_curve = true;
  }
  std::string text;
  if (CaseRecords(records, kAllCase).find("plane_ms") != nullptr)
    text = summaryText(kSummary, records);
  if (has_curve) text.append("\n").append(curve.toString());
  return text;
}

}  // namespace glintmark
