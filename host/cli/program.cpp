#include "host/cli/program.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>

#include "host/cli/command_line.h"
#include "host/core/error.h"
#include "host/report/record/run_info.h"

namespace glintmark {
namespace {

constexpr const char* kDescription =
    "glintmark measures what micro-detail shading costs and what its accuracy costs.";
constexpr const char* kExamples =
    "Examples:\n"
    "  glintmark info\n"
    "  glintmark render sand -o sand.png --star\n"
    "  glintmark heatmap sponza --view grazing -o cells.png\n"
    "  glintmark bench zk16\n"
    "Every subcommand has its own --help.\n"
    "Exit codes: 0 done, 1 a check failed, 2 bad usage or input, 3 no usable device.";

void addCommonOptions(CLI::App& app, CommonOptions& common) {
  app.add_option("--device", common.device,
                 "OpenCL device: its index in 'info' or part of its name")
      ->type_name("I|NAME");
  app.add_option("--width", common.lanes, "Lanes per work-item: 1, 4, 8 or 16 (default: device's)")
      ->type_name("W");
  app.add_option("--threads", common.threads, "Rasterizer threads (default: all cores)")
      ->type_name("N")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--set", common.overrides, "Changes a value of the scene file; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  app.add_option("--mesh", common.mesh_file, "Mesh (OBJ, glTF, PLY) in place of the scene's own")
      ->type_name("FILE");
  app.add_option("--assets", common.asset_folder, "Folder with the real meshes that scenes name")
      ->type_name("FOLDER");
  app.add_flag("--quiet", common.quiet, "No progress and no notes on stderr");
}

// Options of the chosen command, then the common ones, each once.
std::string knownOptions(const CLI::App& app, const CLI::App& command) {
  std::vector<std::string> known;
  for (const CLI::App* level : {&command, &app}) {
    for (const CLI::Option* option : level->get_options()) {
      const std::string name = option->get_name();
      if (option->get_positional() || std::ranges::find(known, name) != known.end()) continue;
      known.push_back(name);
    }
  }
  return fmt::format("{}", fmt::join(known, ", "));
}

std::string knownCommands(const CLI::App& app) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    known.push_back(command->get_name());
  return fmt::format("{}", fmt::join(known, ", "));
}

// The innermost command that was named, or the program itself.
CLI::App& chosenCommand(CLI::App& app) {
  CLI::App* command = &app;
  while (!command->get_subcommands().empty()) command = command->get_subcommands().front();
  return *command;
}

// "glintmark fit ltc"
std::string pathOf(CLI::App& command) {
  CLI::App* parent = command.get_parent();
  return (parent == nullptr ? "" : pathOf(*parent) + " ") + command.get_name();
}

// One sentence for whatever CLI11 did not like.
std::string explain(CLI::App& app, const CLI::ParseError& error) {
  CLI::App& command = chosenCommand(app);
  const std::string name = command.get_name();
  const bool has_commands = !command.get_subcommands(nullptr).empty();
  for (const std::string& word : app.remaining(true)) {
    if (word.starts_with("-")) {
      return fmt::format("unknown option '{}'; {} knows {}", word, name,
                         knownOptions(app, command));
    }
    if (has_commands) {
      return fmt::format("unknown command '{}'; commands of {} are {}", word, name,
                         knownCommands(command));
    }
    return fmt::format("'{}' is one argument too many for {}", word, name);
  }
  if (has_commands && error.get_name() == "RequiredError") {
    return fmt::format("no command given; commands of {} are {} (see {} --help)", name,
                       knownCommands(command), pathOf(command));
  }
  return fmt::format("{} (see {} --help)", error.what(), pathOf(command));
}

}  // namespace

int runProgram(int argc, const char* const* argv) {
  CommandLine line;
  line.words.assign(argv, argv + argc);

  CLI::App app(kDescription, "glintmark");
  app.footer(kExamples);
  app.set_version_flag("--version",
                       fmt::format("glintmark {} ({})", GLINTMARK_VERSION, gitVersion()));
  app.require_subcommand(1);
  addCommonOptions(app, line.common);
  addInfoCommand(app, line);
  addRenderCommand(app, line);
  addHeatmapCommand(app, line);
  addBenchCommand(app, line);
  addAccuracyCommand(app, line);
  addSimulateCommand(app, line);
  addFitCommand(app, line);
  addCompareCommand(app, line);
  addReportCommand(app, line);
  addVerifyCommand(app, line);
  for (CLI::App* command : app.get_subcommands(nullptr)) command->fallthrough();

  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help_or_version) {
    return app.exit(help_or_version);
  } catch (const CLI::ParseError& error) {
    throw Error(explain(app, error));
  }
  return line.action();
}

}  // namespace glintmark
