// What `glintmark verify` says of kernels with a mutant.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace glintmark {

/// What one run of checks found.
struct Trial {
  std::vector<std::string> passed;
  std::vector<std::string> seen_by;     // came to a finding, beyond its bound
  std::vector<std::string> not_judged;  // no finding: it did not build, crashed, or hung
  std::string fault;                    // why there is no table at all, or what was not judged
};

/// Arguments of the program that runs the checks of `checks` (all, where it is empty) and writes
/// what it finds to `json`.
std::vector<std::string> trialArguments(const std::string& checks,
                                        const std::filesystem::path& json);

/// Its environment: a folder for what a failed build leaves, the kernels, and a folder for what the
/// driver compiles; empty: the driver's own.
std::vector<std::string> trialEnvironment(const std::filesystem::path& folder,
                                          const std::filesystem::path& kernels,
                                          const std::filesystem::path& caches);

/// Reads the file that a run has written; `errors` is what it said if it has written none.
Trial readTrial(const std::filesystem::path& json, const std::string& errors);

}  // namespace glintmark
