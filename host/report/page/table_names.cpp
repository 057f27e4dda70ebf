#include "host/report/page/table_names.h"

#include <algorithm>
#include <array>

namespace glintmark {
namespace {

constexpr std::array<TableName, 6> kTables = {{
    {"zk16", "Glints", "Zirr & Kaplanyan 2016, Table 1: GeForce GTX 980, 1920×1080",
     "What glints cost on top of a smooth surface, in five scenes from above and at a grazing "
     "angle.",
     "[ZK16]"},
    {"tan05", "Normal filtering", "Tan et al. 2005: GeForce 6800 GT, 500×500",
     "Mixtures of Gaussians against the other ways to filter a normal map.", "[TAN05]"},
    {"tao21", "Area lights", "Tao et al. 2021, Figs. 5 to 7: GeForce GTX 1070, 1920×1080",
     "Multi-scale linearly transformed cosines beside the original ones and Monte Carlo.",
     "[TAO21]"},
    {"msbrdf", "Multiple scattering",
     "Patapom 2018: 500 million rays in half a second; a GeForce GTX 980 is assumed",
     "Simulated surfaces, the lobes fitted to them, and what the lobes cost at run time.",
     "[PAT18]"},
    {"effects", "Effects on demand", "",
     "Programs made for the effects of a scene against one program with everything in it.", ""},
    {"accuracy", "What accuracy costs", "",
     "Each knob's error against the time it takes, both axes logarithmic. A named setting is "
     "Pareto-optimal: nothing else is both faster and closer.",
     ""},
}};

struct MetricName {
  std::string_view metric, name;
};
constexpr std::array<MetricName, 62> kMetrics = {{
    {"shading_ms", "shading time"},
    {"shading_event_ms", "kernel events"},
    {"frame_with_ms", "frame with glints"},
    {"frame_without_ms", "frame without"},
    {"ns_per_cell", "time per cell"},
    {"normalised_cost", "cost per FLOP over the paper's"},
    {"speedup_vs_w1", "speed-up over one lane"},
    {"cells_min", "fewest cells"},
    {"cells_mean", "mean cells"},
    {"cells_max", "most cells"},
    {"guard_hits", "pixels cut short"},
    {"raster_ms", "rasterizing"},
    {"upload_ms", "upload"},
    {"readback_ms", "readback"},
    {"build_ms", "program build"},
    {"uber_build_ms", "build of the one program"},
    {"first_enqueue_ms", "first launch"},
    {"covered_px", "covered pixels"},
    {"buffer_bytes_per_px", "buffers per pixel"},
    {"kernel_instructions", "instructions of the kernel"},
    {"cell_loop_instructions", "instructions of the cell loop"},
    {"peak_gflops", "peak"},
    {"peak_gbs", "bandwidth"},
    {"rel_mse", "relMSE"},
    {"colour_error", "colour error"},
    {"bias", "bias of the mean"},
    {"truth_stderr", "standard error of the truth"},
    {"multiscale_over_original", "multi-scale over original, time"},
    {"tao21_over_original", "the paper's polynomials over original, time"},
    {"plane_ms", "one quad, full screen"},
    {"mc_spp_at_equal_error", "Monte Carlo samples at equal error"},
    {"mc_time_at_equal_error_over_ltc", "Monte Carlo over ours at equal error, time"},
    {"fit_ms", "fit"},
    {"fps", "frames per second at 500×500"},
    {"frame_to_frame_error", "frame-to-frame error"},
    {"gmm_over_toksvig", "mixtures over Toksvig, time"},
    {"fournier_over_gmm", "Fournier over mixtures, time"},
    {"bytes_per_px", "bytes read per pixel"},
    {"rays_per_s", "rays per second"},
    {"simulate_ms", "simulation"},
    {"simulate_500m_ms", "500 million rays, four orders"},
    {"energy_balance", "energy accounted for"},
    {"lobe_error", "error of our lobes"},
    {"lobe_error_published", "error of the published lobes"},
    {"lobe_error_eon", "error of EON"},
    {"lobe_error_lambert", "error of Lambert"},
    {"furnace", "white furnace"},
    {"runtime_ms", "multiple scattering at run time"},
    {"lambert_ms", "frame with Lambert"},
    {"uber_ms", "one program for all"},
    {"uber_over_specialised", "one program for all over specialised, time"},
    {"uber_on_lists_over_specialised", "one program on the same lists, time"},
    {"full_screen_over_lists", "full screen over pixel lists, time"},
    {"mixed_over_sum", "together over the sum of each alone"},
    {"mixed_over_sum_worst", "the same, worst material"},
    {"planes_bytes", "planes"},
    {"tables_bytes", "tables"},
    {"peak_bytes", "buffers at most"},
    {"error", "error"},
    {"time_ratio", "time over the default's"},
    {"time_ms", "time"},
    {"distribution_distance", "distance of distributions"},
}};

}  // namespace

TableName tableName(std::string_view table) {
  const auto found = std::ranges::find(kTables, table, &TableName::table);
  return found != kTables.end() ? *found : TableName{table, table, "", "", ""};
}

std::string metricName(std::string_view metric, std::string_view unit) {
  const auto found = std::ranges::find(kMetrics, metric, &MetricName::metric);
  std::string name(found != kMetrics.end() ? found->name : metric);
  if (!unit.empty() && unit != "1" && name != unit) name += ", " + std::string(unit);
  return name;
}

std::vector<std::string> companions(std::string_view table, std::string_view metric) {
  if (metric != "shading_ms") return {};
  if (table == "zk16") return {"normalised_cost", "ns_per_cell", "cells_mean", "speedup_vs_w1"};
  if (table == "tao21") return {"rel_mse", "colour_error", "bias", "truth_stderr"};
  return {};
}

std::span<const std::vector<std::string>> curveGroups() {
  static const std::vector<std::vector<std::string>> groups = {
      {"order_1", "order_2", "order_3", "order_4", "order_5", "order_6"},
      {"lobe_error", "lobe_error_published", "lobe_error_eon", "lobe_error_lambert"},
      {"furnace", "furnace_published", "furnace_eon"},
      {"furnace_before", "furnace_after", "furnace_after_simulated"},
      {"shading_ms"},
  };
  return groups;
}

}  // namespace glintmark
