// Subcommands of `glintmark fit`.
#pragma once
#include "host/cli/command_line.h"

namespace glintmark {

void addFitLtcCommand(CLI::App& fit, CommandLine& line);
void addFitMesoCommand(CLI::App& fit, CommandLine& line);
void addFitLobesCommand(CLI::App& fit, CommandLine& line);

}  // namespace glintmark
