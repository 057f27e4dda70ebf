// Subcommands of `glintmark fit`.
#pragma once
#include "host/cli/command_line.h"

namespace glintmark {

void addFitGmmCommand(Command fit, CommandLine& line);
void addFitLtcCommand(Command fit, CommandLine& line);
void addFitMesoCommand(Command fit, CommandLine& line);
void addFitLobesCommand(Command fit, CommandLine& line);
void addFitDielectricCommand(Command fit, CommandLine& line);

/// Makes sure that `file` ends in .png and can be written. Throws Error.
void requireWritablePicture(const std::string& file);

}  // namespace glintmark
