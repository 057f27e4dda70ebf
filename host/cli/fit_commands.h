// Subcommands of `glintmark fit`.
#pragma once
#include "host/cli/command_line.h"

namespace glintmark {

void addFitGmmCommand(Command fit, CommandLine& line);
void addFitLtcCommand(Command fit, CommandLine& line);
void addFitMesoCommand(Command fit, CommandLine& line);
void addFitLobesCommand(Command fit, CommandLine& line);
void addFitDielectricCommand(Command fit, CommandLine& line);

/// Throws Error for a --picture that is none of a PNG; it may be empty.
void requirePng(const std::string& picture);

}  // namespace glintmark
