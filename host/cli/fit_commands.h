// Subcommands of `glintmark fit`.
#pragma once
#include "host/cli/command_line.h"

namespace glintmark {

void addFitGmmCommand(CLI::App& fit, CommandLine& line);
void addFitLtcCommand(CLI::App& fit, CommandLine& line);
void addFitMesoCommand(CLI::App& fit, CommandLine& line);
void addFitLobesCommand(CLI::App& fit, CommandLine& line);

/// Makes sure that `file` ends in .png and can be written. Throws Error.
void requireWritablePicture(const std::string& file);

}  // namespace glintmark
