// What an interrupted verification has kept, and what is not taken for it.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/verify/verification.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

class VerificationLogs : public testing::Test {
 protected:
  VerificationLogs() : file_(fs::temp_directory_path() / ("log_" + std::to_string(getpid()))) {
    run_.device = "some device";
    run_.inputs = "0123456789abcdef";
    VerificationLog log(file_, run_, false);
    for (const char* name : {"a/first", "a/second"}) {
      CheckResult result;
      result.name = name;
      result.verdict = Verdict::kPass;
      result.worst = 0.125;
      result.bound = 0.25;
      log.append(result);
    }
  }
  ~VerificationLogs() override { fs::remove(file_); }

  std::string errorOnResume() const {
    try {
      const VerificationLog log(file_, run_, true);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  const fs::path file_;
  RunInfo run_;
};

TEST_F(VerificationLogs, AreCarriedOn) {
  {
    const VerificationLog log(file_, run_, true);
    ASSERT_EQ(log.kept().size(), 2u);
    EXPECT_EQ(log.kept().at("a/second").worst, 0.125);
  }
  // The last line may have been cut off.
  const std::string text = readFile(file_);
  writeFile(file_, text.substr(0, text.size() - 5));
  EXPECT_EQ(VerificationLog(file_, run_, true).kept().size(), 1u);
}

TEST_F(VerificationLogs, ThatWereChangedAreRefused) {
  const std::string text = readFile(file_);
  for (std::size_t at = 0; at < text.size(); at += 13) {
    if (text[at] == '\n') continue;
    std::string changed = text;
    changed[at] = changed[at] == '2' ? '3' : '2';
    writeFile(file_, changed);
    EXPECT_NE(errorOnResume().find("damaged"), std::string::npos) << at;
  }
}

TEST_F(VerificationLogs, OfOtherKernelsAreRefused) {
  run_.inputs = "fedcba9876543210";
  EXPECT_NE(errorOnResume().find("kernels, tables and scenes"), std::string::npos);
  EXPECT_NE(readFile(file_).find("a/second"), std::string::npos);  // and are still there
}

TEST_F(VerificationLogs, AreNotWrittenThroughLinks) {
  const fs::path other = file_.string() + ".other";
  writeFile(other, "mine");
  fs::remove(file_);
  fs::create_symlink(other, file_);
  { const VerificationLog log(file_, run_, false); }
  EXPECT_EQ(readFile(other), "mine");
  fs::remove(other);
}

}  // namespace
}  // namespace glintmark
