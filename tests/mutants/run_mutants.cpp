// Tries mutants of the kernels: each must fail a check. `./run mutants` starts it.
//
//   mutants [--jobs N] [--only REGEX] [--checks] [--sample]
//
// Exit code 0: every mutant was seen; 1: some was not, or does not build; 2: bad arguments or list.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "host/core/error.h"
#include "host/core/stopwatch.h"
#include "host/report/record/text_table.h"
#include "tests/cli/process.h"
#include "tests/mutants/mutant_list.h"
#include "tests/mutants/mutant_trial.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

const fs::path kKernels = GLINTMARK_SOURCE_DIR "/kernels";

struct Options {
  int jobs = 1;
  std::string only;
  bool sample = false;
  bool named_checks_only = false;  // survivors are not tried with all other checks
};

Options parseOptions(const std::vector<std::string>& words) {
  Options options;
  options.jobs = std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / 2);
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool has_value = i + 1 < words.size();
    if (words[i] == "--sample") {
      options.sample = true;
    } else if (words[i] == "--checks") {
      options.named_checks_only = true;
    } else if (words[i] == "--only" && has_value) {
      options.only = words[++i];
    } else if (words[i] == "--jobs" && has_value) {
      options.jobs = std::atoi(words[++i].c_str());
      if (options.jobs < 1) throw Error("--jobs takes a number from 1 on");
    } else {
      throw Error(fmt::format(
          "'{}' is none of --jobs N, --only REGEX (names of mutants), --sample, --checks "
          "(no others but those that the list names)",
          words[i]));
    }
  }
  return options;
}

std::vector<Mutant> chosenMutants(const Options& options) {
  std::vector<Mutant> mutants = readMutants(GLINTMARK_SOURCE_DIR "/tests/mutants/mutants.toml");
  try {
    const std::regex pattern(options.only);
    std::erase_if(mutants, [&](const Mutant& m) {
      return (options.sample && !m.sample) || !std::regex_search(m.name, pattern);
    });
  } catch (const std::regex_error& error) {
    throw Error(fmt::format("--only '{}' is not a regular expression", options.only));
  }
  if (mutants.empty()) throw Error("no mutant has such a name");
  return mutants;
}

// A run of verify on one folder of kernels.
class VerifyRun {
 public:
  VerifyRun(const fs::path& folder, const fs::path& kernels, const fs::path& caches,
            const std::string& checks)
      : json_(folder / "found.json") {
    fs::remove(json_);
    process_.emplace(trialArguments(checks, json_), trialEnvironment(folder, kernels, caches));
  }
  bool isRunning() const { return process_->isRunning(); }
  Trial end() {
    const ProcessResult result = process_->wait();
    return readTrial(json_, result.err);
  }

 private:
  fs::path json_;
  std::optional<Process> process_;
};

struct Outcome {
  std::string seen_by;  // the first check that fails; empty: it survives
  std::string fault;    // why there is no verdict
  double seconds = 0;
};

// One mutant on its way: first the checks that the list names, then all.
class MutantRun {
 public:
  MutantRun(const Mutant& mutant, const Options& options) : mutant_(mutant), options_(options) {
    writeMutant(mutant, kKernels, folder_ / "kernels");
    start(mutant.checks);
  }

  const Mutant& mutant() const { return mutant_; }

  // The outcome, once there is one.
  std::optional<Outcome> poll() {
    if (run_->isRunning()) return std::nullopt;
    const Trial trial = run_->end();
    Outcome outcome;
    outcome.seconds = watch_.elapsedNs() * 1e-9;
    if (!trial.seen_by.empty()) {
      outcome.seen_by = trial.seen_by.front();
      return outcome;
    }
    if (trial.passed.empty() || !trial.not_judged.empty()) outcome.fault = trial.fault;
    if (!outcome.fault.empty() || all_ || options_.named_checks_only) return outcome;
    all_ = true;
    start("");
    return std::nullopt;
  }

 private:
  void start(const std::string& checks) {
    run_ = std::make_unique<VerifyRun>(folder_.path(), folder_ / "kernels", folder_.path(), checks);
  }

  const Mutant mutant_;
  const Options& options_;
  TempFolder folder_;
  Stopwatch watch_;
  std::unique_ptr<VerifyRun> run_;
  bool all_ = false;
};

// The checks that the list names on the kernels as they are: without it a check that always fails
// would see every mutant. Returns what is wrong.
std::string faultOfUnchanged(const std::vector<Mutant>& mutants) {
  std::set<std::string> patterns;
  std::string all;
  for (const Mutant& m : mutants)
    if (patterns.insert(m.checks).second) all += (all.empty() ? "(" : "|(") + m.checks + ")";
  fmt::print("The kernels as they are, by the checks that {} mutants name\n", mutants.size());
  std::fflush(stdout);
  const TempFolder folder;
  const Trial trial = VerifyRun(folder.path(), kKernels, "", all).end();
  if (!trial.seen_by.empty()) return fmt::format("they fail {}", trial.seen_by.front());
  if (!trial.fault.empty()) return trial.fault;
  for (const Mutant& m : mutants) {
    const std::regex pattern(m.checks);
    if (std::ranges::none_of(trial.passed, [&](const std::string& name) {
          return std::regex_search(name, pattern);
        }))
      return fmt::format("'{}' names the checks {}, of which there are none", m.name, m.checks);
  }
  return "";
}

std::string verdictOf(const Mutant& m, const Outcome& outcome) {
  if (!outcome.fault.empty()) return "no verdict: " + outcome.fault.substr(0, 200);
  if (outcome.seen_by.empty()) return "SURVIVES";
  const bool as_named = std::regex_search(outcome.seen_by, std::regex(m.checks));
  return outcome.seen_by + (as_named ? "" : " (not as named)");
}

std::vector<Outcome> tryAll(const std::vector<Mutant>& mutants, const Options& options) {
  std::vector<Outcome> outcomes(mutants.size());
  std::map<std::size_t, std::unique_ptr<MutantRun>> running;
  for (std::size_t next = 0, done = 0; done < mutants.size();) {
    while (next < mutants.size() && running.size() < static_cast<std::size_t>(options.jobs)) {
      running[next] = std::make_unique<MutantRun>(mutants[next], options);
      ++next;
    }
    usleep(50000);
    for (auto it = running.begin(); it != running.end();) {
      const auto outcome = it->second->poll();
      if (outcome) {
        outcomes[it->first] = *outcome;
        fmt::print("[{}/{}] {}: {} ({:.0f} s)\n", ++done, mutants.size(), mutants[it->first].name,
                   verdictOf(mutants[it->first], *outcome), outcome->seconds);
        std::fflush(stdout);
      }
      it = outcome ? running.erase(it) : std::next(it);
    }
  }
  return outcomes;
}

int runMutants(const Options& options) {
  const std::vector<Mutant> mutants = chosenMutants(options);
  for (const Mutant& m : mutants)
    if (const int found = occurrences(m, kKernels); found != 1)
      throw Error(fmt::format("mutant '{}': its text stands {} times in kernels/{}, not once",
                              m.name, found, m.file));
  const Stopwatch watch;
  if (const std::string fault = faultOfUnchanged(mutants); !fault.empty()) {
    fmt::print(stderr, "glintmark: the kernels without a mutant: {}\n", fault);
    return kExitCheckFailed;
  }
  const std::vector<Outcome> outcomes = tryAll(mutants, options);
  TextTable table({"mutant", "seen by", "s"});
  int seen = 0;
  for (std::size_t i = 0; i < mutants.size(); ++i) {
    const Outcome& o = outcomes[i];
    seen += o.fault.empty() && !o.seen_by.empty();
    table.addRow({mutants[i].name,
                  !o.fault.empty()    ? "no verdict"
                  : o.seen_by.empty() ? "SURVIVES"
                                      : o.seen_by,
                  fmt::format("{:.0f}", o.seconds)});
  }
  fmt::print("\n{}\n{} of {} mutants seen; {:.0f} s.\n", table.toString(), seen, mutants.size(),
             watch.elapsedNs() * 1e-9);
  return seen == static_cast<int>(mutants.size()) ? kExitDone : kExitCheckFailed;
}

}  // namespace
}  // namespace glintmark

int main(int argc, char** argv) {
  try {
    return glintmark::runMutants(
        glintmark::parseOptions(std::vector<std::string>(argv + 1, argv + argc)));
  } catch (const glintmark::Error& error) {
    fmt::print(stderr, "glintmark: {}\n", error.what());
    return 2;
  }
}
