// fit lobes: what it writes, and what impossible options get.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

// Fails with one sentence that has every one of `parts`, and leaves no file in `folder`.
void expectRefusedFit(const TempFolder& folder, std::vector<std::string> options,
                      const std::vector<std::string>& parts) {
  std::vector<std::string> arguments = {"fit", "lobes", "--quiet"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const ProcessResult result = runGlintmark(arguments);
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts)
    EXPECT_NE(result.err.find(part), std::string::npos) << "no '" << part << "' in " << result.err;
  EXPECT_EQ(folder.entryCount(), 0u);
}

TEST(FitLobes, ImpossibleOptionsAreRefusedBeforeAnyWork) {
  const TempFolder folder;
  const std::string output = folder / "out";
  for (const char* rays : {"0", "999", "-5", "1e13", "nan"}) {
    expectRefusedFit(folder, {"-o", output, "--rays", rays}, {"--rays", "1000 to 1e+12"});
    expectRefusedFit(folder, {"-o", output, "--mirror-rays", rays},
                     {"--mirror-rays", "1000 to 1e+12"});
  }
  expectRefusedFit(folder, {"-o", output, "--rays", "many"}, {"--rays", "many"});
  expectRefusedFit(folder, {"-o", output, "--picture", folder / "a.jpg"},
                   {"--picture", "a.jpg", ".png"});
  expectRefusedFit(folder, {"-o", output, "--rais", "2000"}, {"--rais", "--rays"});
}

TEST(FitLobes, OutputsThatCannotBeWrittenAreRefusedBeforeAnyWork) {
  const TempFolder folder;
  const std::string nowhere = folder / "missing";
  expectRefusedFit(folder, {"--picture", nowhere + "/a.png"}, {nowhere});
  expectRefusedFit(folder, {"-o", "/dev/null/out"}, {"/dev/null"});
}

TEST(FitLobes, WritesTablesPicturesAndData) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"fit", "lobes", "--rays", "2000", "--mirror-rays", "1000", "-o", folder / "out",
                    "--picture", folder / "residuals.png", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  for (const char* part : {"free lobe", "PAT18 text", "PAT18 code", "refit", "masking", "EON's",
                           "kernels' lobe", "scale of mu^3"})
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
  std::size_t begin = 0, widest = 0;
  for (std::size_t end; (end = result.out.find('\n', begin)) != std::string::npos; begin = end + 1)
    if (result.out.find("written to", begin) > end) widest = std::max(widest, end - begin);
  EXPECT_LE(widest, 100u);
  for (const char* file : {"multiscatter.json", "free_lobes.csv", "lobe_errors.txt"})
    EXPECT_FALSE(readFile(folder / (std::string("out/") + file)).empty()) << file;
  const std::string csv = readFile(folder / "out/free_lobes.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 11 * 10 * 4);
  EXPECT_GT(readImage(folder / "residuals.png").width, 900);
  EXPECT_GT(readImage(folder / "out/lobe_residuals.png").width, 100);
}

TEST(FitDielectric, WritesItsTables) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"fit", "dielectric", "--rays", "2000", "-o", folder / "out", "--picture",
                    folder / "lobes.png", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("n 1.5: alpha"), std::string::npos) << result.out;
  const std::string csv = readFile(folder / "out/dielectric_lobes.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 5 * 5 * 2 * 4);
  EXPECT_GT(readImage(folder / "lobes.png").width, 400);
  const ProcessResult air = runGlintmark({"fit", "dielectric", "--ior", "1", "--quiet"});
  EXPECT_EQ(air.exit_code, 2);
  EXPECT_NE(air.err.find("is that of air"), std::string::npos) << air.err;
}

}  // namespace
}  // namespace glintmark
