// glintmark fit: what is computed once, before any frame.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

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

void addFitCommand(CLI::App& app, CommandLine& line) {
  CLI::App* command = app.add_subcommand("fit", "Computes the tables that shading needs");
  command->require_subcommand(1);
  addFitGmmCommand(*command, line);
  addFitLtcCommand(*command, line);
  addFitMesoCommand(*command, line);
  addFitLobesCommand(*command, line);
  for (CLI::App* table : command->get_subcommands(nullptr)) table->fallthrough();
}

}  // namespace glintmark
