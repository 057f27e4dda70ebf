// glintmark fit: what is computed once, before any frame.
#include <fmt/format.h>

#include <filesystem>

#include "host/cli/fit_commands.h"
#include "host/core/error.h"

namespace glintmark {

void requirePng(const std::string& picture) {
  if (!picture.empty() && std::filesystem::path(picture).extension() != ".png")
    throw Error(fmt::format("--picture '{}' must end in .png", picture));
}

void addFitCommand(Command app, CommandLine& line) {
  Command command = app.subcommand("fit", "Computes the tables that shading needs");
  command.requireSubcommand();
  addFitGmmCommand(command, line);
  addFitLtcCommand(command, line);
  addFitMesoCommand(command, line);
  addFitLobesCommand(command, line);
  addFitDielectricCommand(command, line);
  command.shareOptions();
}

}  // namespace glintmark
