#include "host/experiment/angle_sweep.h"

#include <fmt/format.h>

#include <array>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/progress.h"
#include "host/core/statistics.h"
#include "host/experiment/count_cells.h"
#include "host/experiment/interrupt.h"
#include "host/report/picture/image_io.h"
#include "host/report/record/terminal_text.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

constexpr std::array kAnglesDeg = {90, 75, 60, 45, 30, 20, 15, 10, 7, 5, 3, 2, 1};
constexpr int kReps = 5;
constexpr int kThumbnailWidthPx = 240;

struct AngleResult {
  int angle_deg = 0;
  CountedCells counted;
  double ns_per_cell = 0;
};

// Median kernel time over the cells of the frame, from a build that does not count.
double measureNsPerCell(Device& device, const Scene& scene, const View& view,
                        const ShadingOptions& shading, int threads, const CellCounts& counts) {
  FrameRenderer renderer(device, scene, view, shading, threads);
  renderer.prepare();
  renderer.shade();  // builds, and compiles on first use
  std::vector<double> times_ns;
  times_ns.reserve(kReps);
  for (int rep = 0; rep < kReps; ++rep) times_ns.push_back(renderer.shade().shading_event_ns);
  const double cells = counts.mean * static_cast<double>(counts.glint_px);
  return cells > 0 ? summarize(times_ns).median / cells : 0;
}

// Every n-th pixel, so that counts stay counts.
Image thumbnail(const Image& cells) {
  const int step = (cells.width + kThumbnailWidthPx - 1) / kThumbnailWidthPx;
  Image small((cells.width + step - 1) / step, (cells.height + step - 1) / step, 1);
  for (int y = 0; y < small.height; ++y) {
    for (int x = 0; x < small.width; ++x) small.at(x, y)[0] = cells.at(x * step, y * step)[0];
  }
  return small;
}

void writeOutputs(const AngleSweep& sweep, const std::vector<AngleResult>& results) {
  if (results.empty()) return;
  TextTable table({"angle", "min", "mean", "max", "guard hits", "ns/cell"});
  std::string csv = "angle_deg,cells_min,cells_mean,cells_max,guard_hits,ns_per_cell\n";
  std::vector<Image> cells;
  std::vector<std::string> captions;
  for (const AngleResult& result : results) {
    const CellCounts& counts = result.counted.counts;
    table.addRow({fmt::format("{} deg", result.angle_deg), fmt::format("{}", counts.min),
                  fmt::format("{:.2f}", counts.mean), fmt::format("{}", counts.max),
                  fmt::format("{}", counts.guard_hits), compactNumber(result.ns_per_cell)});
    csv += fmt::format("{},{},{},{},{},{}\n", result.angle_deg, counts.min, counts.mean, counts.max,
                       counts.guard_hits, result.ns_per_cell);
    cells.push_back(thumbnail(result.counted.cells));
    captions.push_back(fmt::format("{} deg", result.angle_deg));
  }
  printText("{}", table.toString());
  if (!sweep.csv.empty()) writeFile(sweep.csv, csv);
  if (!sweep.picture.empty()) {
    const std::string title =
        fmt::format("{}, cells per pixel by angle to the surface", sweep.scene);
    writePng(heatmapStrip(cells, captions, sweep.scale, title), sweep.picture);
  }
}

}  // namespace

int runAngleSweep(const CommonOptions& common, const AngleSweep& sweep) {
  const Scene scene = openScene(common, sweep.scene);
  const View& base = scene.view(sweep.view);
  if (!base.orbit) {
    throw Error(fmt::format("view '{}' of scene '{}' is not an orbit, so its angle cannot be swept",
                            base.name, scene.name));
  }
  Device device = openDevice(common);
  std::vector<AngleResult> results;
  const InterruptGuard guard;
  Progress progress(common.quiet);
  for (const int angle_deg : kAnglesDeg) {
    if (InterruptGuard::interrupted()) break;
    progress.show(static_cast<int>(results.size()), kAnglesDeg.size(),
                  fmt::format("{} degrees", angle_deg));
    Orbit orbit = *base.orbit;
    orbit.angle_deg = angle_deg;
    const View view = orbitView(base, orbit);
    AngleResult result{.angle_deg = angle_deg,
                       .counted = countCells(device, scene, view, sweep.shading, common.threads)};
    result.ns_per_cell =
        measureNsPerCell(device, scene, view, sweep.shading, common.threads, result.counted.counts);
    results.push_back(std::move(result));
  }
  progress.clear();
  writeOutputs(sweep, results);
  if (results.size() < kAnglesDeg.size()) {
    throw Interrupted(fmt::format("interrupted after {} of {} angles, which are written",
                                  results.size(), kAnglesDeg.size()));
  }
  return kExitDone;
}

}  // namespace glintmark
