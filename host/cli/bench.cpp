// glintmark bench: the papers' timing tables.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "host/cli/command_line.h"
#include "host/cli/output_options.h"
#include "host/experiment/bench.h"
#include "host/frame/shading_options.h"

namespace glintmark {

void addBenchCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<BenchOptions>();
  auto tables = std::make_shared<std::vector<std::string>>();
  auto noise_percent = std::make_shared<double>(0);
  Command command = app.subcommand("bench", "A paper's timing table beside our times");
  command
      .option("table", *tables,
              fmt::format("{} (default: all)", fmt::join(benchTableNames(), ", ")))
      .typeName("TABLE");
  command.option("--scene", options->scenes, "Only these scenes; repeatable").oneValueEach();
  command.option("--view", options->views, "Only these views: steep, grazing; repeatable")
      .oneValueEach();
  command.option("--size", options->size, "Image size (default: 1920x1080, the paper's)")
      .typeName("WxH");
  command.option("--method", options->method, methodHelp());
  command.option("--reps", options->reps, "Repetitions of every measurement (default: 9)");
  command
      .option("--noise", *noise_percent,
              "Repeats until the standard error of a time's median is below this [%]")
      .typeName("PERCENT");
  command
      .option("--max-time", options->max_time_s,
              "Repeats, and begins cases, for at most so many seconds")
      .typeName("SECONDS");
  command
      .option("--warmup", options->warmup, "Frames shaded before those that are timed (default: 1)")
      .typeName("N");
  addOutputOptions(command, *options);
  command.option("--trace", options->trace, "Also writes a Chrome/Perfetto trace of the run")
      .typeName("FILE");
  command.footer(
      "Examples:\n"
      "  glintmark bench\n"
      "  glintmark bench zk16 --scene sponza --view grazing --reps 25\n"
      "  glintmark bench zk16 --noise 1 --max-time 60\n"
      "  glintmark bench zk16 --resume -o results/mine --json mine.json\n"
      "  glintmark bench tan05 --scene disk --trace trace.json    # open it at ui.perfetto.dev");
  command.callback([options, tables, noise_percent, &line] {
    options->noise = *noise_percent / 100;
    line.shares_work = line.common.own_device = true;
    line.action = [options, tables, &line] { return runBench(line, *tables, *options); };
  });
}

}  // namespace glintmark
