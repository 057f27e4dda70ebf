#include "host/experiment/scaling/scaling_table.h"

#include "host/report/record/case_name.h"
#include "host/report/record/case_records.h"
#include "host/report/record/text_table.h"

namespace glintmark {

const TableSpec& scalingSpec() {
  static const TableSpec spec = {
      .name = "scaling",
      .title = "Scaling",
      .about = "One view at more and more pixels, lanes and compute units.",
      .metrics = {{"shading_ms", "ms", "shading time", "kernel events of the frame",
                   "`SCENE/VIEW/height=…`, `…/lanes=…`, `…/threads=…`"},
                  {"ns_per_px", "ns", "time per pixel",
                   "`shading_ms` over covered pixels, all compute units together"},
                  {"prepare_ms", "ms", "preparing",
                   "rasterizing and upload, on the host's threads"},
                  {"buffer_bytes_per_px", "bytes", "buffers per pixel",
                   "device buffers over the pixels of the image"},
                  {"speedup", "1", "speed-up",
                   "time of one lane, or of one compute unit, over this one's; shaded in turn",
                   "`…/lanes=…`, `…/threads=…`"},
                  {"efficiency", "1", "efficiency", "`speedup` over the number of compute units",
                   "`…/threads=…`"}},
      .headline = Headline{"efficiency", "speed-up over the number of compute units"},
      .score = "ns_per_px",
      .curves = {{"ns_per_px"}, {"speedup"}}};
  return spec;
}

std::string scalingTableText(std::span<const Record> records) {
  TextTable table({"case", "shading ms", "ns/px", "prepare ms", "B/px", "speed-up", "efficiency"});
  std::string last_knob;
  for (const std::string& name : caseNames(records)) {
    const CaseName parts = CaseName::parse(name);
    const std::string knob = parts.knobs.empty() ? "" : parts.knobs.back().name;
    if (!last_knob.empty() && knob != last_knob) table.addRule();
    last_knob = knob;
    const CaseRecords one(records, name);
    table.addRow({name, one.text("shading_ms"), one.text("ns_per_px"), one.text("prepare_ms"),
                  one.text("buffer_bytes_per_px"), one.text("speedup"), one.text("efficiency")});
  }
  return table.toString();
}

}  // namespace glintmark
