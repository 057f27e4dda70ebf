// How a subcommand registers itself, and what a parsed command line holds.
#pragma once
#include <functional>

#include "host/cli/command.h"
#include "host/experiment/session.h"

namespace glintmark {

/// One parsed command line. A subcommand's callback sets `action`, which runs after parsing and
/// returns the exit code.
struct CommandLine : Session {
  std::function<int()> action;
  bool opens_device = false;  // in a process that this one watches; others see to it themselves
  bool shares_work = false;   // among ranks; a command that does not is refused to several
};

void addInfoCommand(Command app, CommandLine& line);
void addRenderCommand(Command app, CommandLine& line);
void addExportCommand(Command app, CommandLine& line);
void addHeatmapCommand(Command app, CommandLine& line);
void addAccuracyCommand(Command app, CommandLine& line);
void addScaleCommand(Command app, CommandLine& line);
void addBenchCommand(Command app, CommandLine& line);
void addSimulateCommand(Command app, CommandLine& line);
void addFitCommand(Command app, CommandLine& line);
void addCompareCommand(Command app, CommandLine& line);
void addDiffCommand(Command app, CommandLine& line);
void addReportCommand(Command app, CommandLine& line);
void addProfileCommand(Command app, CommandLine& line);
void addVerifyCommand(Command app, CommandLine& line);

}  // namespace glintmark
