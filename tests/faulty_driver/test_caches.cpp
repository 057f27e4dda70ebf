// PoCL where its cache cannot be written, as in containers under a foreign user, and paths with
// blanks.
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/faulty_driver/faulty.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kOneCheck = {"verify", "--only", "^device/structs$"};

// The test's own cache must not stand in the way; an empty variable is one that PoCL cannot take.
std::vector<std::string> withoutChoice(std::vector<std::string> more) {
  more.insert(more.begin(), {"POCL_CACHE_DIR=", "GLINTMARK_CACHE_DIR=off"});
  return more;
}

// Nobody, root included, makes folders in a file.
TEST(Caches, AHomeThatCannotBeWrittenGetsATemporaryCache) {
  const TempFolder folder;
  writeFile(folder / "home", "no folder");
  fs::create_directory(folder / "tmp");
  const std::string home = folder / "home", tmp = folder / "tmp";
  for (const std::string& variable : {"HOME=" + home, "XDG_CACHE_HOME=" + home}) {
    const ProcessResult result =
        runGlintmark(kOneCheck, withoutChoice({variable, "TMPDIR=" + tmp}));
    EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
    EXPECT_NE(result.err.find("note: PoCL's cache '" + home), std::string::npos) << result.err;
    EXPECT_NE(result.err.find("cannot be written, a temporary one is used"), std::string::npos)
        << result.err;
    EXPECT_TRUE(fs::is_empty(tmp)) << "a temporary cache stays behind";
  }
}

TEST(Caches, ACacheOfAnotherUserIsNotLoadedFrom) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can give folders away";
  const TempFolder folder;
  fs::create_directories(folder / "pocl/kcache");
  ASSERT_EQ(chown((folder / "pocl/kcache").c_str(), 12345, 12345), 0);
  const ProcessResult result =
      runGlintmark(kOneCheck, withoutChoice({"XDG_CACHE_HOME=" + folder.path().string()}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("belongs to another user"), std::string::npos) << result.err;
  EXPECT_TRUE(fs::is_empty(folder / "pocl/kcache"));
}

TEST(Caches, AnEmptyChoiceIsNone) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark(kOneCheck, withoutChoice({"XDG_CACHE_HOME=" + folder.path().string()}));
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err.find("note:"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::is_empty(folder / "pocl/kcache"));
}

TEST(Caches, BlanksAndQuotesInPathsDoNoHarm) {
  const TempFolder folder;
  const fs::path odd = folder / "a folder, that's \"odd\"";
  for (const char* name : {"tmp", "pocl", "programs"}) fs::create_directories(odd / name);
  fs::copy(GLINTMARK_SOURCE_DIR "/kernels", odd / "kernels", fs::copy_options::recursive);
  const ProcessResult result = runGlintmark(
      kOneCheck, {"TMPDIR=" + (odd / "tmp").string(), "POCL_CACHE_DIR=" + (odd / "pocl").string(),
                  "GLINTMARK_CACHE_DIR=" + (odd / "programs").string(),
                  "GLINTMARK_KERNELS=" + (odd / "kernels").string()});
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
}

}  // namespace
}  // namespace glintmark
