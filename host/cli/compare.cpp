// glintmark compare: did a newer run get better or worse?
#include <fmt/format.h>

#include <memory>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/experiment/all_tables.h"
#include "host/report/record/comparison.h"

namespace glintmark {
namespace {

struct CompareOptions {
  std::string old_file, new_file, json;
  double threshold_percent = 5;
  bool all = false, across_devices = false;
};

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

int runCompare(const CompareOptions& options) {
  if (!(options.threshold_percent >= 0 && options.threshold_percent <= 1000))
    throw Error(fmt::format("--threshold {} is not a percentage from 0 to 1000",
                            options.threshold_percent));
  if (!options.json.empty()) requireWritableFile(options.json);
  const Results before = readResults(options.old_file), after = readResults(options.new_file);
  if (!options.across_devices) requireSameDevice(before.run, after.run);
  const double threshold = options.threshold_percent / 100;
  const ComparisonReport report = compareResults(before, after, allTableSpecs(), threshold);
  if (report.comparisons.empty())
    throw Error(
        fmt::format("{} and {} have no figure in common", options.old_file, options.new_file));
  if (!options.json.empty()) writeFile(options.json, comparisonJson(report, threshold));
  fmt::print("{} ({}) against {} ({})\n\n{}", before.run.git, before.run.date, after.run.git,
             after.run.date, comparisonText(report, options.all));
  return report.hasRegression() ? kExitCheckFailed : kExitDone;
}

}  // namespace

void addCompareCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<CompareOptions>();
  Command command = app.subcommand("compare", "What changed between two results files");
  command.option("old", options->old_file, "results.json of the run before").required();
  command.option("new", options->new_file, "results.json of the run after").required();
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
      "medians, 1 %). Exit code 1: something got worse, or is no longer valid.\n"
      "Example:\n  glintmark compare before/results.json after/results.json --threshold 3");
  command.callback([options, &line] { line.action = [options] { return runCompare(*options); }; });
}

}  // namespace glintmark
