// glintmark fit: what is computed once, before any frame.
#include <CLI/CLI.hpp>

#include "host/cli/fit_commands.h"

namespace glintmark {

void addFitCommand(CLI::App& app, CommandLine& line) {
  CLI::App* command = app.add_subcommand("fit", "Computes the tables that shading needs");
  command->require_subcommand(1);
  addFitLtcCommand(*command, line);
  addFitMesoCommand(*command, line);
  addFitLobesCommand(*command, line);
  for (CLI::App* table : command->get_subcommands(nullptr)) table->fallthrough();
}

}  // namespace glintmark
