// How a subcommand registers itself, and what a parsed command line holds.
#pragma once
#include <functional>

#include "host/experiment/session.h"

namespace CLI {
class App;
}

namespace glintmark {

/// One parsed command line. A subcommand's callback sets `action`, which runs after parsing and
/// returns the exit code.
struct CommandLine : Session {
  std::function<int()> action;
};

void addInfoCommand(CLI::App& app, CommandLine& line);
void addRenderCommand(CLI::App& app, CommandLine& line);
void addHeatmapCommand(CLI::App& app, CommandLine& line);
void addAccuracyCommand(CLI::App& app, CommandLine& line);
void addBenchCommand(CLI::App& app, CommandLine& line);
void addSimulateCommand(CLI::App& app, CommandLine& line);
void addFitCommand(CLI::App& app, CommandLine& line);
void addCompareCommand(CLI::App& app, CommandLine& line);
void addReportCommand(CLI::App& app, CommandLine& line);
void addVerifyCommand(CLI::App& app, CommandLine& line);

}  // namespace glintmark
