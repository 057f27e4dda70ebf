#include "host/experiment/zk16/zk16_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {

const TableSpec& zk16Spec() {
  static const TableSpec spec = {
      .name = "zk16",
      .title = "Glints",
      .about =
          "What glints cost on top of a smooth surface, in five scenes from above and at a "
          "grazing angle.",
      .source = "Zirr & Kaplanyan 2016, Table 1: GeForce GTX 980, 1920×1080",
      .citation = "[ZK16]",
      .metrics =
          {{"shading_ms",
            "ms",
            "shading time",
            "the paper's way: the frame with glints minus the frame without (smooth lobes in their "
            "place), measured in turn, median of the differences. A frame here is the kernels' "
            "launches, from enqueue to finish; rasterizing is timed apart",
            "",
            {"normalised_cost", "ns_per_cell", "cells_mean", "speedup_vs_w1"}},
           {"shading_event_ms", "ms", "kernel events",
            "the glint frame's kernels by their OpenCL events, nothing subtracted"},
           {"frame_with_ms", "ms", "frame with glints",
            "the two frames that `shading_ms` subtracts"},
           {"frame_without_ms", "ms", "frame without"},
           {"ns_per_cell", "ns", "time per cell",
            "`shading_ms` over all cells that the frame visits, on all cores together"},
           {"ns_per_paid_cell", "ns", "time per cell paid for", "the same over `cells_paid_mean`"},
           {"normalised_cost", "1", "cost per FLOP over the paper's",
            "(`shading_ms` × peak of this device) / (paper's ms × 4980 GFLOP/s, the GTX 980's "
            "boost "
            "peak): 1 is as efficient per FLOP as the authors' GPU. The peak is measured in the "
            "middle of the frames: `peak_gflops`"},
           {"speedup_vs_w1", "1", "speed-up over one lane",
            "kernel event time of the same source built for one lane over that for all lanes, same "
            "view and size, measured in turn"},
           {"cells_min", "cells", "fewest cells",
            "over pixels of glint materials that some light reaches, by a separate counting build, "
            "never while timing"},
           {"cells_mean", "cells", "mean cells"},
           {"cells_max", "cells", "most cells"},
           {"cells_paid_mean", "cells", "mean cells paid for",
            "cells that lanes work through side by side, those of idle lanes and of steps rounded "
            "up included, over the same pixels"},
           {"guard_hits", "pixels", "pixels cut short",
            "pixels whose walk the limit of 64 cells cut short"},
           {"raster_ms", "ms", "rasterizing",
            "visibility and resolve of the planes the kernels read"},
           {"upload_ms", "ms", "upload", "planes to the device, radiance back"},
           {"readback_ms", "ms", "readback"},
           {"build_ms", "ms", "program build",
            "clBuildProgram; short where the disk cache had the program"},
           {"first_enqueue_ms", "ms", "first launch",
            "first launch of every kernel, in which PoCL compiles it"},
           {"triangles", "triangles", "", "of the scene"},
           {"covered_px", "pixels", "covered pixels", "of the view"},
           {"glint_share", "1", "share of glints",
            "pixels of glint materials over those of the image; the paper's times hold what its "
            "scenes overdraw, these do not: a pixel is shaded once"},
           {"buffer_bytes_per_px", "bytes", "buffers per pixel",
            "device buffers over the pixels of the image"},
           {"peak_gflops", "GFLOP/s", "peak", "measured in the middle of the frames of this view"},
           {"peak_gbs", "GB/s", "bandwidth"},
           {"kernel_instructions", "instructions", "instructions of the kernel",
            "machine code of the compiled kernel, where the device gives it; one instruction "
            "serves "
            "up to `width` pixels. The paper's shader has 412 and 204"},
           {"cell_loop_instructions", "instructions", "instructions of the cell loop"}},
      .headline = Headline{"normalised_cost", "cost of glints per FLOP, the paper's GPU being 1"},
      .score = "shading_event_ms",
      .frame_parts = {{"raster_ms", "rasterizing"},
                      {"upload_ms", "upload"},
                      {"frame_without_ms", "smooth shading"},
                      {"shading_ms", "glints"},
                      {"readback_ms", "readback"}},
      .pictures =
          {{.kind = PictureGroup::Kind::kHeatmaps,
            .heading = "Cells visited per pixel",
            .text = "False colours from 8 to 64 cells, pixels over cells below.",
            .metric = "cells_mean"},
           {.heading = "Cells over the angle of view",
            .metric = "cells_mean",
            .pictures = {{"angle_strip.png", "screen_plane, from steep to grazing",
                          "No angle strip in the folder; glintmark heatmap --sweep-angle -o "
                          "FOLDER/angle_strip.png draws one"}}}},
  };
  return spec;
}

std::optional<double> zk16PaperMs(std::string_view scene, std::string_view view) {
  const auto row = std::ranges::find(kZk16Table1, scene, &Zk16PaperRow::scene);
  if (row == kZk16Table1.end()) return std::nullopt;
  if (view == kZk16Views[0]) return row->steep_ms;
  if (view == kZk16Views[1]) return row->grazing_ms;
  return std::nullopt;
}

std::string zk16TableText(std::span<const Record> records) {
  const auto percentText = [](const Record* share) {
    return share ? fmt::format("{:.0f}%", 100 * share->value.median) : std::string("-");
  };
  TextTable table({"scene", "tris", "view", "glints", "paper ms", "ours ms", "ratio", "norm.cost",
                   "cells min/mean/max", "ns/cell", "xW1"});
  std::string last_scene;
  for (const std::string& name : caseNames(records)) {
    const CaseRecords one(records, name);
    const CaseName parts = CaseName::parse(name);
    const std::string& scene = parts.word(0);
    const Record* shading = one.find("shading_ms");
    const bool has_paper = shading != nullptr && shading->paper.has_value();
    table.addRow({scene == last_scene ? "" : scene,
                  scene == last_scene ? "" : one.count("triangles"), parts.rest().text(),
                  percentText(one.find("glint_share")),
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
