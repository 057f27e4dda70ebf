#include "host/experiment/effects/effects_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "host/experiment/effects/effects_page.h"
#include "host/experiment/summary_table.h"
#include "host/report/picture/matrix_picture.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

constexpr int kEntry_px = 44;
// Ends of the colours; most ratios lie between.
constexpr double kLowRatio = 0.5, kHighRatio = 2.5;

std::string mebibytes(const CaseRecords& records, const char* metric) {
  const Record* record = records.find(metric);
  return record == nullptr ? "-" : compactNumber(record->value.median / kMiB);
}

// The medians of a metric over all cases that have it.
std::vector<double> mediansOf(std::span<const Record> records, const char* metric) {
  std::vector<double> medians;
  for (const Record& record : records)
    if (record.metric == metric) medians.push_back(record.value.median);
  return medians;
}

std::string sentence(std::span<const Record> records) {
  const auto ratios = mediansOf(records, "uber_over_specialised");
  if (ratios.empty()) return "";
  const auto [least, most] = std::ranges::minmax(ratios);
  std::string text = fmt::format(
      "A frame by specialised programs pays only for its effects: one program with every effect\n"
      "takes {:.2f} to {:.2f} times as long.",
      least, most);
  if (const Record* sum = CaseRecords(records, kAllCase).find("mixed_over_sum"))
    text += fmt::format(
        " All effects together cost {:.2f} of the sum of what\neach costs alone (wanted: at most "
        "1.1).",
        sum->value.median);
  return text + "\n";
}

}  // namespace

const TableSpec& effectsSpec() {
  static const TableSpec spec = {
      .name = "effects",
      .title = "Effects on demand",
      .about =
          "Programs made for the effects of a scene against one program with everything in it.",
      .metrics =
          {{"shading_ms", "ms", "shading time",
            "kernel events of the frame: specialised; uber over the full screen"},
           {"uber_ms", "ms", "one program for all"},
           {"uber_over_specialised", "1", "one program for all over specialised, time",
            "uber, all pixels in the order of the screen, over specialised on pixel lists"},
           {"uber_on_lists_over_specialised", "1", "one program on the same lists, time",
            "the uber program on the same pixel lists: what the code that is not needed costs"},
           {"full_screen_over_lists", "1", "full screen over pixel lists, time",
            "the uber program over the full screen, over the same on pixel lists: what branching "
            "within work-items costs"},
           {"mixed_over_sum", "1", "together over the sum of each alone",
            "the frame over base + Σ (effect alone − what it needs), wanted at most 1.1. Lights of "
            "an environment shine in every frame of the sum, since each effect shades each light. "
            "Cases of two surface effects and more"},
           {"mixed_over_sum_worst", "1", "the same, worst material",
            "the same over the pixels of the material that fares worst, among those of at least 2 "
            "% "
            "of the frame"},
           {"planes_bytes", "bytes", "planes", "rasterized planes"},
           {"tables_bytes", "bytes", "tables",
            "all device buffers but planes and radiance: textures, tables, lights, parameters"},
           {"peak_bytes", "bytes", "buffers at most",
            "device buffers really allocated, most at once"},
           {"uber_peak_bytes", "bytes"},
           {"build_ms", "ms", "program build",
            "clBuildProgram and first launches of the set's programs, from source; `note` says if "
            "the disk cache had some. A cold figure needs fresh folders in `GLINTMARK_CACHE_DIR` "
            "and `POCL_CACHE_DIR`"},
           {"uber_build_ms", "ms", "build of the one program"},
           {"programs", "1", "", "different programs of the frame"}},
      .cost_ratios = {"mixed_over_sum", "mixed_over_sum_worst"},
      .headline = Headline{"uber_over_specialised", "times as long if every effect is compiled in"},
      .score = "shading_ms",
      .pictures = {{.kind = PictureGroup::Kind::kHidden,
                    .pictures = {{"effects_matrix.png", "Time ratios of pairs of effects"}}}},
      .section = effectsHtml,
  };
  return spec;
}

std::vector<std::string> singleEffects(std::span<const Record> records) {
  std::vector<std::string> singles;
  for (const std::string& name : caseNames(records))
    if (name != "none" && name != kAllCase && name.find('+') == std::string::npos)
      singles.push_back(name);
  return singles;
}

std::string effectsTableText(std::span<const Record> records) {
  TextTable table({"effects", "ms", "uber", "screen", "sum", "worst", "planes", "tables", "build",
                   "uber build"});
  for (const std::string& name : caseNames(records)) {
    const CaseRecords row(records, name);
    table.addRow({name, row.text("shading_ms"), row.text("uber_over_specialised"),
                  row.text("full_screen_over_lists"), row.text("mixed_over_sum"),
                  row.text("mixed_over_sum_worst"), mebibytes(row, "planes_bytes"),
                  mebibytes(row, "tables_bytes"), row.count("build_ms"),
                  row.count("uber_build_ms")});
  }
  return table.toString() +
         "uber: time of one program with every effect, full screen, branching on each pixel's "
         "material, over\nthat of specialised programs on pixel lists; screen: the same program "
         "on the full screen over lists;\nsum: the frame over the sum of what its effects cost "
         "alone, worst: in its worst material;\nplanes and tables in MiB, builds in ms.\n\n" +
         sentence(records);
}

Image effectsMatrixPicture(std::span<const Record> records) {
  const std::vector<std::string> effects = singleEffects(records);
  const std::size_t n = effects.size();
  std::vector<double> uber(n * n, 0), mixed(n * n, 0);
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t column = 0; column < n; ++column) {
      // Names of pairs have the order of the effects.
      const auto [first, second] = std::minmax(row, column);
      const CaseRecords pair(records, first == second
                                          ? effects[first]
                                          : fmt::format("{}+{}", effects[first], effects[second]));
      if (const Record* record = pair.find("uber_over_specialised"))
        uber[row * n + column] = record->value.median;
      if (const Record* record = pair.find("mixed_over_sum"))
        mixed[row * n + column] = record->value.median;
      else
        mixed[row * n + column] = first == second ? 1 : 0;
    }
  if (n == 0) return Image(1, 1, 3);
  const std::string order = fmt::format("{}", fmt::join(effects, ", "));
  return matrixPicture({{"uber over specialised", uber}, {"mixed over sum", mixed}},
                       {.width = static_cast<int>(n),
                        .height = static_cast<int>(n),
                        .entry_px = kEntry_px,
                        .low = kLowRatio,
                        .high = kHighRatio,
                        .title = "time ratios of pairs of effects",
                        .x_label = order,
                        .y_label = "the same"});
}

}  // namespace glintmark
