// Whole files: what is written is what is read, and what fails leaves nothing behind.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <iterator>
#include <set>
#include <string>

#include "host/core/atomic_file.h"
#include "host/core/error.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

class AtomicFiles : public testing::Test {
 protected:
  AtomicFiles()
      : folder_(fs::temp_directory_path() / ("glintmark-files-" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~AtomicFiles() override { fs::remove_all(folder_); }

  std::ptrdiff_t filesInFolder() const {
    return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
  }

  fs::path folder_;
};

TEST_F(AtomicFiles, AreReadAsTheyWereWritten) {
  std::string bytes;
  for (int i = 0; i < 300000; ++i) bytes += static_cast<char>(i % 251);
  for (const std::size_t size :
       {std::size_t{0}, std::size_t{1}, std::size_t{65535}, std::size_t{65536}, bytes.size()}) {
    writeFile(folder_ / "a", std::string_view(bytes).substr(0, size));
    EXPECT_EQ(readFile(folder_ / "a"), bytes.substr(0, size)) << size;
  }
  EXPECT_EQ(filesInFolder(), 1);
}

TEST_F(AtomicFiles, PiecesFollowEachOther) {
  writeFile(folder_ / "a", {"head\n", "", "body"}, Durability::kUnsynced);
  EXPECT_EQ(readFile(folder_ / "a"), "head\nbody");
}

TEST_F(AtomicFiles, FilesWithoutASizeAreReadWhole) {
  EXPECT_EQ(fs::file_size("/proc/self/status"), 0u);
  EXPECT_NE(readFile("/proc/self/status").find("\nPid:"), std::string::npos);
}

TEST_F(AtomicFiles, WhatCannotBeReadIsNamed) {
  for (const fs::path& path : {folder_, folder_ / "gone"}) {
    try {
      readFile(path);
      ADD_FAILURE() << path << " was read";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("cannot read " + path.string()), std::string::npos);
    }
  }
}

TEST_F(AtomicFiles, WhatHasNoEndOrDoesNotAnswerIsRefused) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  for (const fs::path& path : {folder_ / "pipe", fs::path("/dev/zero"), fs::path("/dev/null")}) {
    try {
      readFile(path);
      ADD_FAILURE() << path << " was read";
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("a device, a pipe or a socket"), std::string::npos);
    }
  }
}

TEST_F(AtomicFiles, TemporaryNamesCannotBeGuessedAndAreShortEnough) {
  std::set<std::string> names;
  for (int i = 0; i < 50; ++i) {
    const AtomicFile file(folder_ / "a");
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
      names.insert(entry.path().filename().string());
  }
  EXPECT_EQ(names.size(), 50u);
  const std::string longest(255, 'n');
  writeFile(folder_ / longest, "x");
  EXPECT_EQ(readFile(folder_ / longest), "x");
}

TEST_F(AtomicFiles, WhatAKilledRunLeftGoesWithTheNextAndWhatLivesStays) {
  const pid_t child = fork();
  if (child == 0) {
    const AtomicFile file(folder_ / "a");
    _exit(0);  // without destructors, as a kill ends it
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  const AtomicFile living(folder_ / "b");
  // Those of a process of that number elsewhere are held by a lock.
  const fs::path foreign = folder_ / (".c.00112233445566ff.1" + std::to_string(child) + ".tmp");
  // What another program named so is no business of ours.
  const fs::path other = folder_ / (".c." + std::to_string(child) + ".tmp");
  close(open(other.c_str(), O_WRONLY | O_CREAT, 0600));
  const int held = open(foreign.c_str(), O_WRONLY | O_CREAT, 0600);
  flock(held, LOCK_EX);
  removeAbandonedFiles(folder_);
  EXPECT_EQ(filesInFolder(), 3);
  EXPECT_TRUE(fs::exists(foreign));
  close(held);
  removeAbandonedFiles(folder_);
  EXPECT_EQ(filesInFolder(), 2);
  EXPECT_TRUE(fs::exists(other));
}

TEST_F(AtomicFiles, WhatFailsLeavesTheOldFileAndNothingElse) {
  writeFile(folder_ / "a", "old");
  { const AtomicFile never_committed(folder_ / "a"); }
  EXPECT_EQ(readFile(folder_ / "a"), "old");
  fs::create_directory(folder_ / "b");
  EXPECT_THROW(writeFile(folder_ / "b", "new"), Error);
  EXPECT_THROW(writeFile(folder_ / "gone" / "a", "new"), Error);
  EXPECT_EQ(filesInFolder(), 2);
}

}  // namespace
}  // namespace glintmark
