// glintmark bench: the papers' timing tables.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>

#include "host/cli/command_line.h"
#include "host/cli/zk16_bench.h"
#include "host/core/error.h"

namespace glintmark {
namespace {

int runBench(const CommandLine& line, const std::vector<std::string>& tables,
             const BenchOptions& options) {
  for (const std::string& table : tables) {
    if (table != "zk16") throw Error(fmt::format("unknown table '{}'; tables are zk16", table));
  }
  if (options.reps < 1 || options.reps > 10000) {
    throw Error(fmt::format("--reps {} is not from 1 to 10000", options.reps));
  }
  return runZk16Bench(line, options);
}

}  // namespace

void addBenchCommand(CLI::App& app, CommandLine& line) {
  auto options = std::make_shared<BenchOptions>();
  auto tables = std::make_shared<std::vector<std::string>>();
  CLI::App* command = app.add_subcommand("bench", "A paper's timing table beside our times");
  command->add_option("table", *tables, "zk16 (default: all there are)")->type_name("TABLE");
  command->add_option("--scene", options->scenes, "Only these scenes; repeatable")
      ->allow_extra_args(false);
  command->add_option("--view", options->views, "Only these views: steep, grazing; repeatable")
      ->allow_extra_args(false);
  command->add_option("--size", options->size, "Image size (default: 1920x1080, the paper's)")
      ->type_name("WxH");
  command->add_option("--method", options->method, "zk16 or exact (default: zk16)");
  command->add_option("--reps", options->reps, "Repetitions of every measurement (default: 9)");
  command->add_option("-o,--output", options->folder, "Results folder (default: results/latest)")
      ->type_name("FOLDER");
  command->add_option("--json", options->json, "Also writes the records to this JSON file")
      ->type_name("FILE");
  command->add_option("--csv", options->csv, "Also writes the records to this CSV file")
      ->type_name("FILE");
  command->add_flag("--resume", options->resume, "Keeps what an interrupted run has measured");
  command->footer(
      "Examples:\n"
      "  glintmark bench\n"
      "  glintmark bench zk16 --scene sponza --view grazing --reps 25\n"
      "  glintmark bench zk16 --resume -o results/mine --json mine.json");
  command->callback([options, tables, &line] {
    line.action = [options, tables, &line] { return runBench(line, *tables, *options); };
  });
}

}  // namespace glintmark
