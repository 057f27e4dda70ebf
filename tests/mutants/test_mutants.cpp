// The list of mutants against the kernels as they are, and what counts as seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "tests/cli/process.h"
#include "tests/mutants/mutant_list.h"
#include "tests/mutants/mutant_trial.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

const fs::path kSourceKernels = GLINTMARK_SOURCE_DIR "/kernels";

std::vector<Mutant> wholeList() {
  return readMutants(GLINTMARK_SOURCE_DIR "/tests/mutants/mutants.toml");
}

TEST(MutantList, EveryTextStandsOnceInTheKernels) {
  for (const Mutant& m : wholeList())
    EXPECT_EQ(occurrences(m, kSourceKernels), 1) << m.name << " in kernels/" << m.file;
}

TEST(MutantList, IsLongAndBreaksEveryFolderOfKernels) {
  const std::vector<Mutant> mutants = wholeList();
  EXPECT_GE(mutants.size(), 60u);
  for (const fs::directory_entry& entry : fs::directory_iterator(kSourceKernels)) {
    const std::string folder = entry.path().filename().string() + "/";
    // Its own kernels are tests/sample's; probes call what stands elsewhere.
    if (!entry.is_directory() || folder == "sample/" || folder == "probes/") continue;
    EXPECT_TRUE(std::ranges::any_of(mutants, [&](const Mutant& m) {
      return m.file.starts_with(folder);
    })) << folder;
  }
}

TEST(MutantList, NamesChecksThatExist) {
  const ProcessResult list = runGlintmark({"verify", "--list"});
  ASSERT_EQ(list.exit_code, 0) << list.err;
  std::vector<std::string> names;
  std::istringstream lines(list.out);
  for (std::string name; std::getline(lines, name);) names.push_back(name);
  for (const Mutant& m : wholeList()) {
    const std::regex pattern(m.checks);
    EXPECT_TRUE(std::ranges::any_of(
        names, [&](const std::string& name) { return std::regex_search(name, pattern); }))
        << m.name << ": " << m.checks;
  }
}

TEST(MutantList, BadOnesAreOneSentence) {
  const TempFolder folder;
  const fs::path file = folder / "list.toml";
  const std::string whole =
      "[[mutant]]\nname = 'a'\nfile = 'f'\ntext = 't'\nbecomes = 'b'\nchecks = 'c'\nwhy = 'w'\n";
  const auto message = [&](const std::string& text) {
    writeFile(file, text);
    return messageOf<Error>([&] { readMutants(file); });
  };
  EXPECT_NE(message("").find("has no [[mutant]]"), std::string::npos);
  EXPECT_NE(message("[[mutant]]\nname = 'a'\n").find(":1: a mutant needs the text 'file'"),
            std::string::npos);
  EXPECT_NE(message(whole + "cheks = 'x'\n").find(":8: mutants have no key 'cheks'"),
            std::string::npos);
  EXPECT_NE(message(whole + whole).find("has 'a' twice"), std::string::npos);
  EXPECT_NE(message("[[mutant\n").find("list.toml:1: "), std::string::npos);
}

TEST(MutantKernels, AreACopyWithOneChange) {
  const TempFolder folder;
  const Mutant m = {"a", "glint/hash.clh", "0x9E3779B1u", "0x9E3779B3u", ".", "", false};
  writeMutant(m, kSourceKernels, folder / "kernels");
  std::string text = readFile(kSourceKernels / m.file);
  text.replace(text.find(m.text), m.text.size(), m.becomes);
  EXPECT_EQ(readFile(folder / "kernels/glint/hash.clh"), text);
  EXPECT_EQ(readFile(folder / "kernels/types.h"), readFile(kSourceKernels / "types.h"));
  Mutant twice = m;
  twice.text = "#define";
  EXPECT_THROW(writeMutant(twice, kSourceKernels, folder / "more"), Error);
}

TEST(MutantTrials, WhatDoesNotBuildIsNotSeen) {
  const TempFolder folder;
  const Mutant m = {"a", "glint/hash.clh", "return sum ^ (sum >> 15);", "return", ".", "", false};
  writeMutant(m, kSourceKernels, folder / "kernels");
  const fs::path json = folder / "found.json";
  const ProcessResult result =
      runGlintmark(trialArguments("^seeds/integers$", json),
                   trialEnvironment(folder.path(), folder / "kernels", folder.path()));
  EXPECT_EQ(result.exit_code, 1) << result.err;
  const Trial trial = readTrial(json, result.err);
  EXPECT_TRUE(trial.seen_by.empty());
  EXPECT_EQ(trial.not_judged, std::vector<std::string>{"seeds/integers"});
  EXPECT_FALSE(trial.fault.empty());
  // What a failed build leaves for its reader is not left to all.
  EXPECT_NE(result.out.find("options, log and sources are in " + (folder / "").string()),
            std::string::npos)
      << result.out << result.err;
}

}  // namespace
}  // namespace glintmark
