// glintmark fit: what is computed once, before any frame.
#include <fmt/format.h>

#include <filesystem>

#include "host/cli/fit_commands.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"

namespace glintmark {

void requireWritablePicture(const std::string& file) {
  if (std::filesystem::path(file).extension() != ".png")
    throw Error(fmt::format("--picture '{}' must end in .png", file));
  requireWritableFile(file);
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
