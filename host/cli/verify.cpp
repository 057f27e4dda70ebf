// glintmark verify: does this device compute what the papers say?
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <regex>
#include <utility>

#include "host/cli/command_line.h"
#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/output_files.h"
#include "host/core/progress.h"
#include "host/core/stopwatch.h"
#include "host/experiment/interrupt.h"
#include "host/experiment/run_inputs.h"
#include "host/harness/kernel_bench.h"
#include "host/report/record/records.h"
#include "host/report/record/terminal_text.h"
#include "host/report/record/text_table.h"
#include "host/verify/check.h"
#include "host/verify/check_process.h"
#include "host/verify/verification.h"

namespace glintmark {
namespace {

struct VerifyOptions {
  std::string only, json, junit;
  double timeout_s = 600;
  bool list = false, resume = false;
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

std::string tableText(const std::vector<CheckResult>& results) {
  TextTable table({"check", "verdict", "worst", "bound", "of"});
  for (const CheckResult& r : results)
    table.addRow({r.name, verdictName(r.verdict), fmt::format("{:.3g}", r.worst),
                  fmt::format("{:.3g}", r.bound), r.measure});
  return table.toString();
}

// The log stands beside the file that is written at the end.
std::filesystem::path logFile(const VerifyOptions& options) {
  const std::string& file = options.json.empty() ? options.junit : options.json;
  return file.empty() ? std::filesystem::path() : std::filesystem::path(file + ".partial");
}

// Runs checks in child processes, one after the other; a child that is lost is replaced.
class Verifier {
 public:
  Verifier(const CommandLine& line, const VerifyOptions& options, std::vector<Check> checks)
      : line_(line), options_(options), checks_(std::move(checks)) {
    found_.chosen = checks_.size();
  }

  // Returns whether every check has run.
  bool run() {
    const InterruptGuard guard;
    const Stopwatch watch;
    bool whole = true;
    try {
      startChild();
      const std::filesystem::path file = logFile(options_);
      if (!file.empty()) log_ = VerificationLog(file, found_.run, options_.resume);
      for (std::size_t i = 0; i < checks_.size(); ++i) runOne(i);
    } catch (const Interrupted&) {
      whole = false;
    }
    progress_.clear();
    found_.seconds = watch.elapsedNs() * 1e-9;
    return whole;
  }

  const Verification& found() const { return found_; }
  VerificationLog& log() { return log_; }

 private:
  void startChild() {
    child_ = std::make_unique<CheckProcess>(checks_, [this] {
      KernelBench bench(openUntried(line_.common));  // its checks try it
      const RunInfo run = describeRun(line_, bench.device);
      return CheckProcess::Opened{std::move(bench), run.width, headerLine(run)};
    });
    found_.run = parseHeaderLine(
        child_->awaitDevice(options_.timeout_s, InterruptGuard::interrupted), "the child's device");
    found_.run.inputs = inputs_;
  }

  void runOne(std::size_t i) {
    const auto kept = log_.kept().find(checks_[i].name);
    if (kept != log_.kept().end()) {
      found_.results.push_back(kept->second);
      return;
    }
    if (InterruptGuard::interrupted()) throw Interrupted("interrupted");
    if (!child_->isAlive()) startChild();
    name(i);
    found_.results.push_back(child_->run(i, options_.timeout_s, InterruptGuard::interrupted));
    log_.append(found_.results.back());
  }

  // Whatever hangs is the check that was named last, on terminals and in logs.
  void name(std::size_t i) {
    progress_.show(static_cast<int>(i), static_cast<int>(checks_.size()), checks_[i].name);
    if (!line_.common.quiet && isatty(STDERR_FILENO) != 1)
      fmt::print(stderr, "[{}/{}] {}\n", i + 1, checks_.size(), checks_[i].name);
  }

  const CommandLine& line_;
  const VerifyOptions& options_;
  const std::vector<Check> checks_;
  const std::string inputs_ = hashInputs(line_.common, {});
  Progress progress_{line_.common.quiet};
  std::unique_ptr<CheckProcess> child_;
  VerificationLog log_;
  Verification found_;
};

void printFound(const Verification& found) {
  const RunInfo& run = found.run;
  printText("{} ({}), {} lanes\n\n{}\n", run.device, run.driver, run.width,
            tableText(found.results));
  for (const CheckResult& r : found.results)
    if (!r.note.empty()) printText("{}: {}\n", r.name, r.note);
  printText("{} checks: {} pass, {} fail, {} skipped; {:.0f} s.\n", found.results.size(),
            found.count(Verdict::kPass), found.count(Verdict::kFail),
            found.count(Verdict::kSkipped), found.seconds);
}

void checkOptions(const VerifyOptions& options) {
  if (!(options.timeout_s > 0))
    throw Error(fmt::format("--timeout {} is not a positive number of seconds", options.timeout_s));
  if (options.resume && logFile(options).empty())
    throw Error("--resume needs the --json or --junit file of the run that it carries on with");
  announceOutputs({{"--json", options.json},
                   {"--junit", options.junit},
                   {"the log of --json", logFile(options).string()}});
}

int runVerify(const CommandLine& line, const VerifyOptions& options) {
  std::vector<Check> checks = chosenChecks(options.only);
  if (options.list) {
    for (const Check& check : checks) fmt::print("{}\n", check.name);
    return kExitDone;
  }
  checkOptions(options);
  prepareDrivers(line.common);  // here, not once more in every process
  Verifier verifier(line, options, std::move(checks));
  const bool whole = verifier.run();
  const Verification& found = verifier.found();
  if (!options.json.empty()) writeFile(options.json, verificationJson(found));
  if (!options.junit.empty()) writeFile(options.junit, verificationJunit(found));
  if (!found.results.empty()) printFound(found);
  std::fflush(stdout);
  if (!whole)
    throw Interrupted(fmt::format("interrupted; {} of {} checks ran{}", found.results.size(),
                                  found.chosen,
                                  logFile(options).empty() ? "" : ", --resume carries on"));
  verifier.log().discard();
  return found.count(Verdict::kFail) > 0 ? kExitCheckFailed : kExitDone;
}

}  // namespace

void addVerifyCommand(Command app, CommandLine& line) {
  auto options = std::make_shared<VerifyOptions>();
  Command command = app.subcommand(
      "verify", "Checks every kernel on the chosen device and width against references");
  command.option("--only", options->only, "Only checks whose name this matches").typeName("REGEX");
  command.flag("--list", options->list, "Lists the checks and runs none");
  command.option("--json", options->json, "Also writes the findings to this file").typeName("FILE");
  command.option("--junit", options->junit, "The same as JUnit's XML").typeName("FILE");
  command
      .option("--timeout", options->timeout_s,
              "Seconds after which a check has failed and its process is ended (default: 600)")
      .typeName("S");
  command.flag("--resume", options->resume,
               "Runs only what an interrupted run has not kept in FILE.partial");
  command.footer(
      "A check passes where its worst error is within its bound. Checks run in a process of their\n"
      "own: a driver that crashes or hangs costs one of them. Exit code 0: all pass, 1: some\n"
      "failed, 3: no device.\n"
      "Examples:\n"
      "  glintmark verify\n"
      "  glintmark verify --device 1 --width 4 --json verify.json\n"
      "  glintmark verify --junit verify.xml --timeout 120 --resume\n"
      "  glintmark verify --only '^(polygon|hard_light)/'");
  command.callback(
      [options, &line] { line.action = [options, &line] { return runVerify(line, *options); }; });
}

}  // namespace glintmark
