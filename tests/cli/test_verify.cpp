// verify as its users run it: choosing checks, the JSON, and kernels that are broken on purpose.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "host/core/atomic_file.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

ProcessResult verify(const std::string& only, const std::vector<std::string>& more = {},
                     const std::string& kernels = "") {
  std::vector<std::string> arguments = {"verify", "--quiet", "--only", only};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::vector<std::string> environment;
  if (!kernels.empty()) environment = {"GLINTMARK_KERNELS=" + kernels, "GLINTMARK_CACHE_DIR=off"};
  return runGlintmark(arguments, environment);
}

TEST(Verify, ListsEveryCheckAndRunsNone) {
  const ProcessResult result = runGlintmark({"verify", "--list"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_GT(std::ranges::count(result.out, '\n'), 40);
  EXPECT_NE(result.out.find("seeds/integers\n"), std::string::npos) << result.out;
  EXPECT_EQ(result.out.find("pass"), std::string::npos);
}

TEST(Verify, TableAndJsonSayTheSame) {
  const TempFolder folder;
  const ProcessResult result = verify("^seeds/", {"--json", folder / "verify.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err << result.out;
  EXPECT_NE(result.out.find("2 checks: 2 pass, 0 fail, 0 skipped"), std::string::npos)
      << result.out;
  const auto json = nlohmann::json::parse(readFile(folder / "verify.json"));
  EXPECT_EQ(json["schema"], "glintmark.verification/1");
  EXPECT_EQ(json["passed"], 2);
  EXPECT_FALSE(json["run"]["device"].get<std::string>().empty());
  ASSERT_EQ(json["checks"].size(), 2u);
  for (const auto& check : json["checks"]) {
    EXPECT_EQ(check["verdict"], "pass");
    EXPECT_LE(check["worst"], check["bound"]);
  }
  EXPECT_EQ(folder.entryCount(), 1u);  // no temporary file stays behind
}

TEST(Verify, CatchesAChangedHash) {
  const TempFolder folder;
  const fs::path kernels = changedKernels(folder, "glint/hash.clh", "0x7FEB352Du", "0x7FEB352Fu");
  const ProcessResult result =
      verify("^seeds/integers$", {"--json", folder / "verify.json"}, kernels);
  EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
  EXPECT_NE(result.out.find("FAIL"), std::string::npos) << result.out;
  const auto json = nlohmann::json::parse(readFile(folder / "verify.json"));
  EXPECT_EQ(json["failed"], 1);
}

TEST(Verify, CatchesAByteSumWithAWrongMean) {
  const TempFolder folder;
  const fs::path kernels =
      changedKernels(folder, "glint/byte_sum.clh", "MEAN 510.0f", "MEAN 511.0f");
  const ProcessResult result = verify("^seeds/random_numbers$", {}, kernels);
  EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
}

TEST(Verify, AKernelThatDoesNotCompileFails) {
  const TempFolder folder;
  const fs::path kernels =
      changedKernels(folder, "glint/hash.clh", "WIDE vuint mixCell", "WIDE oops");
  const ProcessResult result = verify("^seeds/integers$", {}, kernels);
  EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
}

TEST(Verify, BadInput) {
  const ProcessResult nothing = verify("no_such_check");
  EXPECT_EQ(nothing.exit_code, 2);
  EXPECT_NE(nothing.err.find("no check matches"), std::string::npos) << nothing.err;
  const ProcessResult malformed = verify("(");
  EXPECT_EQ(malformed.exit_code, 2);
  EXPECT_NE(malformed.err.find("not a regular expression"), std::string::npos) << malformed.err;
  EXPECT_EQ(verify("^seeds/", {"--json", "/no/such/folder/verify.json"}).exit_code, 2);
  EXPECT_EQ(verify("^seeds/", {"--device", "no such device"}).exit_code, 3);
  EXPECT_EQ(verify("^seeds/", {"--width", "5"}).exit_code, 2);
}

}  // namespace
}  // namespace glintmark
