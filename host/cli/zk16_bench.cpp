#include "host/cli/zk16_bench.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "host/cli/interrupt.h"
#include "host/cli/zk16_case.h"
#include "host/core/error.h"
#include "host/core/progress.h"
#include "host/report/atomic_file.h"
#include "host/report/heatmap.h"
#include "host/report/image_io.h"
#include "host/report/record_log.h"
#include "host/report/records.h"
#include "host/report/zk16_table.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

// The chosen names in the order of the known ones; all of them if none is chosen.
template <typename Known>
std::vector<std::string> selectNames(const char* what, const Known& known,
                                     const std::vector<std::string>& chosen) {
  for (const std::string& name : chosen) {
    if (std::ranges::find(known, name) == known.end()) {
      throw Error(fmt::format("unknown {} '{}' of table zk16; {}s are {}", what, name, what,
                              fmt::join(known, ", ")));
    }
  }
  std::vector<std::string> names;
  for (const auto& name : known) {
    if (chosen.empty() || std::ranges::find(chosen, name) != chosen.end()) names.emplace_back(name);
  }
  return names;
}

std::vector<std::string> selectScenes(const std::vector<std::string>& chosen) {
  std::array<std::string_view, kZk16Table1.size()> known;
  std::ranges::transform(kZk16Table1, known.begin(), &Zk16PaperRow::scene);
  return selectNames("scene", known, chosen);
}

// What tells one measurement of a case from another; part of every record's configuration.
std::map<std::string, std::string> measurementKey(const CommonOptions& common,
                                                  const BenchOptions& options, int lanes) {
  std::map<std::string, std::string> key = {{"size", options.size},
                                            {"method", options.method},
                                            {"reps", std::to_string(options.reps)},
                                            {"width", std::to_string(lanes)}};
  if (!common.overrides.empty()) key["set"] = fmt::format("{}", fmt::join(common.overrides, " "));
  if (!common.mesh_file.empty()) key["mesh"] = common.mesh_file;
  if (!common.asset_folder.empty()) key["assets"] = common.asset_folder;
  return key;
}

// The log's records of one case, if it was measured whole with this key.
std::vector<Record> findCase(const RecordLog& log, const std::string& name,
                             const std::map<std::string, std::string>& key) {
  std::vector<Record> records = log.recordsOf("zk16", name, key);
  const bool whole = std::ranges::all_of(zk16Metrics(), [&](const std::string& metric) {
    return std::ranges::find(records, metric, &Record::metric) != records.end();
  });
  return whole ? records : std::vector<Record>();
}

class Zk16Bench {
 public:
  Zk16Bench(const CommandLine& line, const BenchOptions& options)
      : line_(line),
        options_(options),
        folder_(options.folder),
        scenes_(selectScenes(options.scenes)),
        views_(selectNames("view", kZk16Views, options.views)),
        device_(openDevice(line.common)),
        cache_(device_),
        run_(describeRun(line, device_)),
        key_(measurementKey(line.common, options, run_.width)) {
    const ImageSize size = parseSize(options.size);
    settings_.shading = {.width_px = size.width_px,
                         .height_px = size.height_px,
                         .lanes = run_.width,
                         .method = parseMethod(options.method)};
    settings_.reps = options.reps;
    settings_.w1_reps = std::min(options.reps, settings_.w1_reps);
    settings_.threads = line.common.threads;
  }

  int run();

 private:
  void measureAll(RecordLog& log);
  void measureOne(RecordLog& log, const Scene& scene, const std::string& view);
  void writeResults();
  std::string tableText() const;
  bool allValid() const { return std::ranges::all_of(records_, &Record::valid); }

  const CommandLine& line_;
  const BenchOptions& options_;
  fs::path folder_;
  std::vector<std::string> scenes_, views_;
  Device device_;
  ProgramCache cache_;
  RunInfo run_;
  std::map<std::string, std::string> key_;
  Zk16Settings settings_;
  std::vector<Record> records_;
};

void Zk16Bench::measureOne(RecordLog& log, const Scene& scene, const std::string& view) {
  const Zk16Case measured =
      measureZk16Case(device_, cache_, scene, scene.view(view), settings_, key_);
  const Image picture = heatmapPicture(
      measured.counted.cells, {.title = fmt::format("{}/{}, cells per pixel", scene.name, view),
                               .guard_hits = measured.counted.counts.guard_hits});
  writePng(picture, folder_ / fmt::format("cells_{}_{}.png", scene.name, view));
  log.append(measured.records);
  records_.insert(records_.end(), measured.records.begin(), measured.records.end());
}

void Zk16Bench::measureAll(RecordLog& log) {
  Progress progress(line_.common.quiet);
  const int total = static_cast<int>(scenes_.size() * views_.size());
  int done = 0;
  for (const std::string& scene_name : scenes_) {
    std::optional<Scene> scene;  // loaded only if some view of it is left to measure
    for (const std::string& view : views_) {
      const std::string name = scene_name + "/" + view;
      progress.show(done, total, name);
      const std::vector<Record> old = findCase(log, name, key_);
      if (!old.empty()) {
        records_.insert(records_.end(), old.begin(), old.end());
        ++done;
        continue;
      }
      try {
        if (!scene) scene = openScene(line_.common, scene_name);
        measureOne(log, *scene, view);
      } catch (const Interrupted&) {
        throw Interrupted(
            fmt::format("interrupted; {} of {} views are kept in {}, --resume "
                        "carries on",
                        done, total, (folder_ / "records.jsonl").string()));
      }
      ++done;
    }
  }
}

std::string Zk16Bench::tableText() const {
  std::string text = fmt::format(
      "[ZK16] Table 1 at {}, {} lanes, {:.0f} GFLOP/s FMA peak (the paper's GTX 980: {:.0f})\n",
      options_.size, run_.width, run_.peak_gflops, kGtx980PeakGflops);
  text += fmt::format("on {:.90}\n\n", run_.device);
  text += zk16TableText(records_) + "\n" + zk16BreakdownText(records_);
  const auto counts = [&](const char* metric) {
    return std::ranges::find(records_, metric, &Record::metric);
  };
  const auto kernel = counts("kernel_instructions"), loop = counts("cell_loop_instructions");
  if (kernel != records_.end() && loop != records_.end()) {
    text += fmt::format(
        "\nStatic instructions of {}'s kernel, {} pixels at once:\n"
        "{:.0f}, of which {:.0f} in the cell loop, which takes four cells at a time "
        "(paper: {} and {})\n",
        kernel->case_, run_.width, kernel->value.median, loop->value.median,
        kZk16ShaderInstructions, kZk16LoopInstructions);
  }
  std::string last_case;
  for (const Record& record : records_) {
    if (record.valid || record.case_ == last_case) continue;
    text += fmt::format("{} {:.75}\n", record.case_, record.note);
    last_case = record.case_;
  }
  return text;
}

void Zk16Bench::writeResults() {
  const std::string json = toJson({run_, records_}), csv = toCsv(records_), table = tableText();
  writeFile(folder_ / "results.json", json);
  writeFile(folder_ / "results.csv", csv);
  writeFile(folder_ / "table.txt", table);
  if (!options_.json.empty()) writeFile(options_.json, json);
  if (!options_.csv.empty()) writeFile(options_.csv, csv);
  fmt::print("{}\nwritten to {}\n", table, folder_.string());
}

int Zk16Bench::run() {
  requireWritableFolder(folder_);
  for (const std::string& file : {options_.json, options_.csv}) {
    if (!file.empty()) requireWritableFile(file);
  }
  const InterruptGuard guard;
  const DevicePeaks peaks = measurePeaks(device_, cache_, run_.width);
  run_.peak_gflops = peaks.gflops;
  run_.peak_gbs = peaks.gbs;
  const fs::path log_file = folder_ / "records.jsonl";
  RecordLog log =
      options_.resume ? RecordLog::resume(log_file, run_) : RecordLog::create(log_file, run_);
  measureAll(log);
  writeResults();
  return allValid() ? kExitDone : kExitCheckFailed;
}

}  // namespace

int runZk16Bench(const CommandLine& line, const BenchOptions& options) {
  return Zk16Bench(line, options).run();
}

}  // namespace glintmark
