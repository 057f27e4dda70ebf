#include "host/experiment/tao21/tao21_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

struct SummaryRow {
  const char* metric;
  const char* what;
  const char* paper;
};
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

std::string tao21TableText(std::span<const Record> records) {
  TextTable table({"case", "ms", "relMSE", "colour err", "bias", "truth s.e."});
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    if (one.find("rel_mse") == nullptr) continue;
    table.addRow({name, one.text("shading_ms"), one.text("rel_mse"), one.text("colour_error"),
                  one.text("bias"), one.text("truth_stderr")});
  }
  return table.toString();
}

std::string tao21SummaryText(std::span<const Record> records) {
  const CaseRecords all(records, "all");
  TextTable table({"over all", "ours", "paper"});
  for (const SummaryRow& row : kSummary) {
    if (all.find(row.metric) != nullptr) table.addRow({row.what, all.text(row.metric), row.paper});
  }
  TextTable curve({"area_plane", "ms"});
  bool has_curve = false;
  for (const std::string& name : caseNames(records)) {
    const std::size_t equals = name.find('=');
    if (!name.starts_with("area_plane/") || equals == std::string::npos) continue;
    curve.addRow({name.substr(name.find('/') + 1), CaseRecords(records, name).text("shading_ms")});
    has_curve = true;
  }
  return (all.find("plane_ms") != nullptr ? table.toString() : std::string()) +
         (has_curve ? "\n" + curve.toString() : std::string());
}

}  // namespace glintmark
