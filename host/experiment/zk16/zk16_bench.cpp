// glintmark bench zk16: Table 1 of [ZK16] over scenes and views, and its breakdown; a heatmap of
// cells per view.
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "host/experiment/all_tables.h"
#include "host/experiment/paper_gpu.h"
#include "host/experiment/zk16/zk16_case.h"
#include "host/experiment/zk16/zk16_table.h"
#include "host/report/picture/heatmap.h"
#include "host/report/record/case_name.h"

namespace glintmark {
namespace {

std::vector<std::string> zk16Scenes() {
  std::vector<std::string> scenes;
  std::ranges::transform(kZk16Table1, std::back_inserter(scenes),
                         [](const Zk16PaperRow& row) { return std::string(row.scene); });
  return scenes;
}

std::vector<std::string> zk16Views() {
  return {kZk16Views.begin(), kZk16Views.end()};
}

std::vector<Record> measureView(BenchRun& run, const Scene& scene, const std::string& view) {
  Zk16Case measured = measureZk16Case(run, scene, scene.view(view));
  const Image picture = heatmapPicture(
      measured.counted.cells, {.title = fmt::format("{}/{}, cells per pixel", scene.name, view),
                               .guard_hits = measured.counted.counts.guard_hits});
  run.keepPicture(picture, heatmapFile({{scene.name, view}}));
  return std::move(measured.records);
}

void measure(BenchRun& run) {
  std::vector<std::string> cases;
  for (const std::string& scene : selectNames(zk16Scenes(), run.options().scenes))
    for (const std::string& view : selectNames(zk16Views(), run.options().views))
      cases.push_back(CaseName{{scene, view}}.text());
  std::optional<Scene> scene;  // loaded only if some view of it is left to measure
  run.measureCases(zk16Spec().name, cases, zk16Metrics(), [&](const std::string& name) {
    const CaseName wanted = CaseName::parse(name);
    if (!scene || scene->name != wanted.word(0))
      scene = openScene(run.session().common, wanted.word(0));
    return measureView(run, *scene, wanted.word(1));
  });
}

std::string staticCountsText(const std::vector<Record>& records, int lanes) {
  const auto kernel = std::ranges::find(records, "kernel_instructions", &Record::metric);
  const auto loop = std::ranges::find(records, "cell_loop_instructions", &Record::metric);
  if (kernel == records.end() || loop == records.end()) return "";
  return fmt::format(
      "\nStatic instructions of {}'s kernel, {} pixels at once:\n"
      "{:.0f}, of which {:.0f} in the cell loop, which takes four cells at a time "
      "(paper: {} and {})\n",
      kernel->case_, lanes, kernel->value.median, loop->value.median, kZk16ShaderInstructions,
      kZk16LoopInstructions);
}

std::string text(const BenchRun& run) {
  const RunInfo& info = run.info();
  const std::vector<Record> records = run.recordsOf(zk16Spec().name);
  return fmt::format(
             "[ZK16] Table 1 at {}, {} lanes, {:.0f} GFLOP/s FMA peak (the paper's GTX 980: "
             "{:.0f})\non {:.90}\n\n",
             run.options().size, info.width, info.peak_gflops, kGtx980PeakGflops, info.device) +
         zk16TableText(records) + "\n" + zk16BreakdownText(records) +
         staticCountsText(records, info.width) + invalidText(records);
}

}  // namespace

BenchTable zk16Bench() {
  return {zk16Spec(), zk16Scenes(), zk16Views(), measure, text};
}

}  // namespace glintmark
