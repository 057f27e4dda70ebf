// glintmark bench: the papers' timing tables.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "host/cli/command_line.h"
#include "host/cli/output_options.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/trace.h"
#include "host/experiment/bench_run.h"
#include "host/experiment/effects/effects_bench.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/msbrdf/msbrdf_bench.h"
#include "host/experiment/tan05/tan05_bench.h"
#include "host/experiment/tao21/tao21_bench.h"
#include "host/experiment/zk16/zk16_bench.h"
#include "host/report/record/trace_file.h"

namespace glintmark {
namespace {

// In the order in which they are measured and printed.
std::vector<BenchTable> allTables() {
  return {zk16Bench(), tan05Bench(), tao21Bench(), msbrdfBench(), effectsBench()};
}

std::vector<std::string> namesOf(const std::vector<BenchTable>& tables) {
  std::vector<std::string> names;
  for (const BenchTable& table : tables) names.push_back(table.name);
  return names;
}

// Throws Error if some chosen name is none of the known ones.
void requireKnown(const char* what, const std::vector<std::string>& chosen,
                  const std::vector<std::string>& known) {
  for (const std::string& name : chosen) {
    if (std::ranges::find(known, name) == known.end())
      throw Error(
          fmt::format("unknown {} '{}'; {}s are {}", what, name, what, fmt::join(known, ", ")));
  }
}

// Does the table have any of the chosen names?
bool offersAny(const std::vector<std::string>& known, const std::vector<std::string>& chosen) {
  return chosen.empty() || !selectNames(known, chosen).empty();
}

std::vector<BenchTable> chooseTables(const std::vector<std::string>& names,
                                     const BenchOptions& options) {
  std::vector<BenchTable> tables = allTables();
  requireKnown("table", names, namesOf(tables));
  if (!names.empty())
    std::erase_if(tables, [&](const BenchTable& table) {
      return std::ranges::find(names, table.name) == names.end();
    });
  std::vector<std::string> scenes, views;
  for (const BenchTable& table : tables) {
    scenes.insert(scenes.end(), table.scenes.begin(), table.scenes.end());
    views.insert(views.end(), table.views.begin(), table.views.end());
  }
  requireKnown("scene", options.scenes, scenes);
  requireKnown("view", options.views, views);
  std::erase_if(tables, [&](const BenchTable& table) {
    return !offersAny(table.scenes, options.scenes) || !offersAny(table.views, options.views);
  });
  return tables;
}

int runBench(const CommandLine& line, const std::vector<std::string>& names,
             const BenchOptions& options) {
  const std::vector<BenchTable> tables = chooseTables(names, options);
  const InterruptGuard guard;
  if (!options.trace.empty()) {
    requireWritableFile(options.trace);
    startTrace();
  }
  BenchRun run(line, options);
  for (const BenchTable& table : tables) table.measure(run);
  std::string text;
  for (const BenchTable& table : tables) text += (text.empty() ? "" : "\n") + table.text(run);
  if (!options.trace.empty()) writeTrace(options.trace, run.info());
  return run.finish(text);
}

}  // namespace

void addBenchCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<BenchOptions>();
  auto tables = std::make_shared<std::vector<std::string>>();
  Command command = app.subcommand("bench", "A paper's timing table beside our times");
  command
      .option("table", *tables,
              fmt::format("{} (default: all)", fmt::join(namesOf(allTables()), ", ")))
      .typeName("TABLE");
  command.option("--scene", options->scenes, "Only these scenes; repeatable").oneValueEach();
  command.option("--view", options->views, "Only these views: steep, grazing; repeatable")
      .oneValueEach();
  command.option("--size", options->size, "Image size (default: 1920x1080, the paper's)")
      .typeName("WxH");
  command.option("--method", options->method, "zk16 or exact (default: zk16)");
  command.option("--reps", options->reps, "Repetitions of every measurement (default: 9)");
  addOutputOptions(command, *options);
  command.option("--trace", options->trace, "Also writes a Chrome/Perfetto trace of the run")
      .typeName("FILE");
  command.footer(
      "Examples:\n"
      "  glintmark bench\n"
      "  glintmark bench zk16 --scene sponza --view grazing --reps 25\n"
      "  glintmark bench zk16 --resume -o results/mine --json mine.json\n"
      "  glintmark bench tan05 --scene disk --trace trace.json    (open it at ui.perfetto.dev)");
  command.callback([options, tables, &line] {
    line.action = [options, tables, &line] { return runBench(line, *tables, *options); };
  });
}

}  // namespace glintmark
