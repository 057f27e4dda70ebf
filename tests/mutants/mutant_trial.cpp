#include "tests/mutants/mutant_trial.h"

#include <nlohmann/json.hpp>

#include "host/core/atomic_file.h"

namespace glintmark {

namespace fs = std::filesystem;

std::vector<std::string> trialArguments(const std::string& checks, const fs::path& json) {
  std::vector<std::string> arguments = {"verify",      "--quiet",   "--json",
                                        json.string(), "--timeout", "300"};
  if (!checks.empty()) arguments.insert(arguments.end(), {"--only", checks});
  return arguments;
}

std::vector<std::string> trialEnvironment(const fs::path& folder, const fs::path& kernels,
                                          const fs::path& caches) {
  // A binary to keep would have PoCL, which keeps its own, compile every kernel once more.
  std::vector<std::string> environment = {"TMPDIR=" + folder.string(),
                                          "GLINTMARK_KERNELS=" + kernels.string(),
                                          "GLINTMARK_PROGRAM_CACHE=off"};
  if (!caches.empty()) environment.push_back("POCL_CACHE_DIR=" + (caches / "pocl").string());
  return environment;
}

Trial readTrial(const fs::path& json, const std::string& errors) {
  Trial trial;
  if (!fs::exists(json)) {
    trial.fault = errors.empty() ? "it ended without a word" : errors;
    return trial;
  }
  const auto found = nlohmann::json::parse(readFile(json));
  for (const auto& check : found["checks"]) {
    const std::string name = check["name"];
    if (check["verdict"] == "pass") trial.passed.push_back(name);
    if (check["verdict"] != "FAIL") continue;
    if (check["judged"].get<bool>()) {
      trial.seen_by.push_back(name);
    } else {
      trial.not_judged.push_back(name);
      trial.fault = check["note"];
    }
  }
  return trial;
}

}  // namespace glintmark
