// glintmark verify: does this device compute what the papers say?
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <regex>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/stopwatch.h"
#include "host/experiment/interrupt.h"
#include "host/harness/kernel_bench.h"
#include "host/report/record/text_table.h"
#include "host/verify/check.h"

namespace glintmark {
namespace {

struct VerifyOptions {
  std::string only, json;
  bool list = false;
};

std::vector<Check> chosenChecks(const std::string& only) {
  std::vector<Check> checks = allChecks();
  if (only.empty()) return checks;
  try {
    const std::regex pattern(only);
    std::erase_if(checks,
                  [&](const Check& check) { return !std::regex_search(check.name, pattern); });
  } catch (const std::regex_error& error) {
    throw Error(fmt::format("--only '{}' is not a regular expression: {}", only, error.what()));
  }
  if (checks.empty())
    throw Error(fmt::format("no check matches --only '{}'; --list shows them all", only));
  return checks;
}

// A line that the next one overwrites, on terminals only.
void showProgress(const std::string& text) {
  if (isatty(STDERR_FILENO)) fmt::print(stderr, "\r\033[K{}", text);
}

std::vector<CheckResult> runAll(const std::vector<Check>& checks, const CheckContext& context,
                                bool quiet) {
  const InterruptGuard guard;
  std::vector<CheckResult> results;
  for (const Check& check : checks) {
    if (InterruptGuard::interrupted())
      throw Interrupted("interrupted; nothing is written of a verification that is not whole");
    if (!quiet)
      showProgress(fmt::format("{}/{} {}", results.size() + 1, checks.size(), check.name));
    results.push_back(runCheck(check, context));
  }
  if (!quiet) showProgress("");
  return results;
}

std::size_t countOf(const std::vector<CheckResult>& results, Verdict verdict) {
  return static_cast<std::size_t>(std::ranges::count(results, verdict, &CheckResult::verdict));
}

std::string tableText(const std::vector<CheckResult>& results) {
  TextTable table({"check", "verdict", "worst", "bound", "of"});
  for (const CheckResult& r : results)
    table.addRow({r.name, verdictName(r.verdict), fmt::format("{:.3g}", r.worst),
                  fmt::format("{:.3g}", r.bound), r.measure});
  return table.toString();
}

std::string verificationJson(const RunInfo& run, const std::vector<CheckResult>& results,
                             double seconds) {
  const auto count = [&](Verdict verdict) { return countOf(results, verdict); };
  nlohmann::ordered_json json = {{"schema", "glintmark.verification/1"},
                                 {"run",
                                  {{"date", run.date},
                                   {"git", run.git},
                                   {"command", run.command},
                                   {"cpu", run.cpu},
                                   {"cores", run.cores},
                                   {"device", run.device},
                                   {"driver", run.driver},
                                   {"platform", run.platform},
                                   {"width", run.width}}},
                                 {"passed", count(Verdict::kPass)},
                                 {"failed", count(Verdict::kFail)},
                                 {"skipped", count(Verdict::kSkipped)},
                                 {"seconds", seconds}};
  nlohmann::ordered_json& list = json["checks"] = nlohmann::ordered_json::array();
  for (const CheckResult& r : results) {
    nlohmann::ordered_json item = {{"name", r.name},      {"verdict", verdictName(r.verdict)},
                                   {"worst", nullptr},    {"bound", r.bound},
                                   {"of", r.measure},     {"note", r.note},
                                   {"seconds", r.seconds}};
    if (std::isfinite(r.worst)) item["worst"] = r.worst;
    list.push_back(std::move(item));
  }
  return json.dump(1) + "\n";
}

int runVerify(const CommandLine& line, const VerifyOptions& options) {
  const std::vector<Check> checks = chosenChecks(options.only);
  if (options.list) {
    for (const Check& check : checks) fmt::print("{}\n", check.name);
    return kExitDone;
  }
  if (!options.json.empty()) requireWritableFile(options.json);
  KernelBench bench(openDevice(line.common));
  const RunInfo run = describeRun(line, bench.device);
  const Stopwatch watch;
  const std::vector<CheckResult> results = runAll(checks, {bench, run.width}, line.common.quiet);
  const double seconds = watch.elapsedNs() * 1e-9;
  if (!options.json.empty()) writeFile(options.json, verificationJson(run, results, seconds));

  fmt::print("{} ({}), {} lanes\n\n{}\n", run.device, run.driver, run.width, tableText(results));
  for (const CheckResult& r : results)
    if (!r.note.empty()) fmt::print("{}: {}\n", r.name, r.note);
  fmt::print("{} checks: {} pass, {} fail, {} skipped; {:.0f} s.\n", results.size(),
             countOf(results, Verdict::kPass), countOf(results, Verdict::kFail),
             countOf(results, Verdict::kSkipped), seconds);
  return countOf(results, Verdict::kFail) > 0 ? kExitCheckFailed : kExitDone;
}

}  // namespace

void addVerifyCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<VerifyOptions>();
  Command command = app.subcommand(
      "verify", "Checks every kernel on the chosen device and width against references");
  command.option("--only", options->only, "Only checks whose name this matches").typeName("REGEX");
  command.flag("--list", options->list, "Lists the checks and runs none");
  command.option("--json", options->json, "Also writes the findings to this file").typeName("FILE");
  command.footer(
      "A check passes where its worst error is within its bound. Exit code 0: all pass,\n"
      "1: some failed, 3: no device.\n"
      "Examples:\n"
      "  glintmark verify\n"
      "  glintmark verify --device 1 --width 4 --json verify.json\n"
      "  glintmark verify --only '^(polygon|hard_light)/'");
  command.callback(
      [options, &line] { line.action = [options, &line] { return runVerify(line, *options); }; });
}

}  // namespace glintmark
