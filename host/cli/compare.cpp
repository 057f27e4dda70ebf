// glintmark compare: did newer runs get better or worse?
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/experiment/all_tables.h"
#include "host/report/record/comparison.h"
#include "host/report/record/run_table.h"
#include "host/report/record/terminal_text.h"

namespace glintmark {
namespace {

constexpr int kMostRuns = 1000;

struct CompareOptions {
  std::vector<std::string> files;
  std::string json;
  double threshold_percent = 5;
  bool all = false, across_devices = false;
};

// A folder of results, or its file.
Results resultsAt(const std::string& path) {
  const std::filesystem::path file = path;
  return readResults(std::filesystem::is_directory(file) ? file / "results.json" : file);
}

void requireSameDevice(const RunInfo& before, const RunInfo& after) {
  const auto describe = [](const RunInfo& run) {
    return fmt::format("{} ({}, {} lanes)", run.device, run.driver, run.width);
  };
  const std::string a = describe(before), b = describe(after);
  if (a != b)
    throw Error(fmt::format(
        "the old file was measured on {}, the new one on {}; --across-devices compares them anyway",
        a, b));
}

int compareTwo(const CompareOptions& options, const Results& before, const Results& after) {
  const double threshold = options.threshold_percent / 100;
  const ComparisonReport report = compareResults(before, after, allTableSpecs(), threshold);
  if (!options.json.empty()) writeFile(options.json, comparisonJson(report, threshold));
  printText("{} ({}) against {} ({})\n\n{}", before.run.git, before.run.date, after.run.git,
            after.run.date, comparisonText(report, options.all));
  return report.hasRegression() ? kExitCheckFailed : kExitDone;
}

int compareMany(const CompareOptions& options, const std::vector<Results>& runs) {
  const double threshold = options.threshold_percent / 100;
  const RunTable table = tabulateRuns(runs, allTableSpecs(), threshold);
  if (!options.json.empty()) writeFile(options.json, runTableJson(table, options.files, threshold));
  printText("{}", runTableText(table, runs, options.files, options.all));
  return table.hasRegression() ? kExitCheckFailed : kExitDone;
}

int runCompare(const CompareOptions& options) {
  if (!(options.threshold_percent >= 0 && options.threshold_percent <= 1000))
    throw Error(fmt::format("--threshold {} is not a percentage from 0 to 1000",
                            options.threshold_percent));
  announceOutputs({{"--json", options.json}});
  std::vector<Results> runs;
  for (const std::string& file : options.files) runs.push_back(resultsAt(file));
  for (std::size_t i = 1; i < runs.size(); ++i) {
    if (!options.across_devices) requireSameDevice(runs[0].run, runs[i].run);
    if (compareResults(runs[0], runs[i], {}, 0).comparisons.empty())
      throw Error(
          fmt::format("{} and {} have no figure in common", options.files[0], options.files[i]));
  }
  return runs.size() == 2 ? compareTwo(options, runs[0], runs[1]) : compareMany(options, runs);
}

}  // namespace

void addCompareCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<CompareOptions>();
  Command command = app.subcommand("compare", "What changed between results, two or more");
  command
      .option("results", options->files, "Folders of results or their results.json, oldest first")
      .required()
      .typeName("RESULTS")
      .values(2, kMostRuns);
  command
      .option("--threshold", options->threshold_percent,
              "Smallest difference that counts [%] (default: 5)")
      .typeName("PERCENT");
  command.flag("--all", options->all, "Also lists what did not change");
  command.flag("--across-devices", options->across_devices,
               "Compares runs of different devices, drivers or lanes");
  command.option("--json", options->json, "Also writes the comparison to this file")
      .typeName("FILE");
  command.footer(
      "A difference counts if it is beyond the threshold and beyond noise (Welch's t on the\n"
      "medians, 1 %). Exit code 1: something got worse, or is no longer valid. Three runs or more\n"
      "are one table of ratios to the first.\n"
      "Examples:\n"
      "  glintmark compare before/results.json after/results.json --threshold 3\n"
      "  glintmark compare --across-devices results/*/2026-11-26 --json ratios.json");
  command.callback([options, &line] { line.action = [options] { return runCompare(*options); }; });
}

}  // namespace glintmark
