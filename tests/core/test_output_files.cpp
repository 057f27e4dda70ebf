// Outputs are never written over inputs, whoever comes first.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "host/core/atomic_file.h"
#include "host/core/output_files.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

class OutputFiles : public testing::Test {
 protected:
  OutputFiles()
      : folder_(fs::temp_directory_path() / ("glintmark-outputs-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    writeFile(folder_ / "in", "input");
  }
  ~OutputFiles() override { fs::remove_all(folder_); }

  // What is said of writing over an input named `file`; empty if it is written.
  std::string refusal(const fs::path& file) const {
    try {
      writeFile(file, "output");
      return {};
    } catch (const OverwriteError& error) {
      EXPECT_EQ(readFile(folder_ / "in", FileRole::kOwn), "input");
      return error.what();
    }
  }

  fs::path folder_;
};

TEST_F(OutputFiles, AreNoneThatWasRead) {
  const InputGuard guard;
  EXPECT_EQ(readFile(folder_ / "in"), "input");
  fs::create_symlink(folder_ / "in", folder_ / "link");
  fs::create_hard_link(folder_ / "in", folder_ / "hard");
  for (const char* name : {"in", "link", "hard", "./in"})
    EXPECT_NE(refusal(folder_ / name).find("would be written over what is read"), std::string::npos)
        << name;
  EXPECT_EQ(refusal(folder_ / "other"), "");
  EXPECT_THROW(announceOutputs({{"--csv", folder_ / "in"}}), OverwriteError);
}

TEST_F(OutputFiles, AnnouncedAreRefusedAsInputsBeforeTheyAreWritten) {
  const InputGuard guard;
  announceOutputs({{"-o", folder_ / "in"}, {"--csv", ""}});
  std::string said;
  try {
    readFile(folder_ / "in");
  } catch (const OverwriteError& error) {
    said = error.what();
  }
  EXPECT_EQ(said, "-o '" + (folder_ / "in").string() +
                      "' would be written over what is read; choose another name");
  EXPECT_EQ(readFile(folder_ / "in", FileRole::kOwn), "input");
  EXPECT_EQ(refusal(folder_ / "in"), said) << "by whoever reads on all the same";
}

TEST_F(OutputFiles, AreEachOthersNever) {
  const InputGuard guard;
  announceOutputs({{"-o", folder_ / "new"}});
  try {
    announceOutputs({{"--csv", folder_ / "." / "new"}});
    FAIL() << "two outputs are one file";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("is the file of -o too"), std::string::npos)
        << error.what();
  }
}

TEST_F(OutputFiles, WhatTheProgramKeepsIsWrittenAgain) {
  const InputGuard guard;
  announceOutputs({{"--checkpoint", folder_ / "in"}});
  EXPECT_EQ(readFile(folder_ / "in", FileRole::kOwn), "input");
  writeFile(folder_ / "in", "more");
  EXPECT_EQ(readFile(folder_ / "in"), "more") << "it is there now";
}

TEST_F(OutputFiles, OfAnInputThatIsGoneTheNameIsFree) {
  const InputGuard guard;
  readFile(folder_ / "in");
  fs::rename(folder_ / "in", folder_ / "elsewhere");  // has its number
  writeFile(folder_ / "elsewhere", "output");
  writeFile(folder_ / "in", "output");
}

TEST_F(OutputFiles, AreNotWatchedWithoutAGuard) {
  { const InputGuard guard; }
  readFile(folder_ / "in");
  writeFile(folder_ / "in", "output");
  EXPECT_EQ(readFile(folder_ / "in"), "output");
}

}  // namespace
}  // namespace glintmark
