#include "host/report/record/folder_lock.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

TEST(FolderLock, OneHolderAtATime) {
  const TempFolder folder;
  {
    const FolderLock lock(folder.path());
    const std::string message = messageOf<Error>([&] { FolderLock again(folder.path()); });
    EXPECT_NE(message.find("process " + std::to_string(getpid())), std::string::npos) << message;
  }
  EXPECT_EQ(folder.entryCount(), 0u);
  const FolderLock again(folder.path());
}

TEST(FolderLock, AFileThatAKilledRunLeftIsNoLock) {
  const TempFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock lock(folder.path());
    _exit(0);  // without destructors, as a kill ends it
  }
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  EXPECT_EQ(folder.entryCount(), 1u);
  const FolderLock lock(folder.path());
}

// The holder's child shares its lock for three seconds more, longer than a holder that is well
// gets.
TEST(FolderLock, AHolderThatWasKilledIsWaitedFor) {
  const TempFolder folder;
  int ready[2] = {};
  ASSERT_EQ(pipe(ready), 0);
  const pid_t holder = fork();
  if (holder == 0) {
    const FolderLock lock(folder.path());
    if (fork() == 0) {
      std::this_thread::sleep_for(std::chrono::seconds(3));
      _exit(0);
    }
    if (write(ready[1], "x", 1) != 1) _exit(1);
    while (true) pause();
  }
  char byte = 0;
  ASSERT_EQ(read(ready[0], &byte, 1), 1);
  ASSERT_EQ(kill(holder, SIGKILL), 0);
  // Nobody has collected the holder's end: it is there still, as one that is being ended is.
  EXPECT_NO_THROW(FolderLock{folder.path()});
  EXPECT_EQ(waitpid(holder, nullptr, 0), holder);
  for (const int end : ready) close(end);
}

TEST(FolderLock, LinksAndPipesAreNotFollowed) {
  const TempFolder folder;
  writeFile(folder / "target", "kept");
  std::filesystem::create_symlink(folder / "target", folder / ".lock");
  EXPECT_NE(messageOf<Error>([&] { FolderLock lock(folder.path()); }).find("symbolic link"),
            std::string::npos);
  EXPECT_EQ(readFile(folder / "target"), "kept");
  std::filesystem::remove(folder / ".lock");
  ASSERT_EQ(mkfifo((folder / ".lock").c_str(), 0600), 0);
  EXPECT_NE(messageOf<Error>([&] { FolderLock lock(folder.path()); }).find("not the lock file"),
            std::string::npos);
}

// "results" locks "results.lock", which may be somebody's file.
TEST(FolderLock, FilesOfOthersStayAsTheyAre) {
  const TempFolder folder;
  for (const std::string text :
       {"a lock of another program", "12 13", "1234567890123456789012345678901234"}) {
    writeFile(folder / ".lock", text);
    EXPECT_NE(messageOf<Error>([&] { FolderLock lock(folder.path()); }).find("not the lock file"),
              std::string::npos);
    EXPECT_EQ(readFile(folder / ".lock"), text);
  }
  writeFile(folder / ".lock", "");  // of a run that was killed early
  { const FolderLock lock(folder.path()); }
  EXPECT_FALSE(std::filesystem::exists(folder / ".lock"));
}

TEST(FolderLock, OnlyFilesOfTheDeadAreRemoved) {
  const TempFolder folder;
  const pid_t child = fork();
  if (child == 0) _exit(0);
  ASSERT_EQ(waitpid(child, nullptr, 0), child);
  const std::string random = ".results.json.0123456789abcdef.",
                    dead = random + std::to_string(child) + ".tmp",
                    own = random + std::to_string(getpid()) + ".tmp",
                    another_programs = ".results.json." + std::to_string(child) + ".tmp";
  for (const std::string& name :
       {dead, own, another_programs, std::string(".other.tmp"), std::string("a.1x.tmp")})
    writeFile(folder / name, "x");
  removeAbandonedFiles(folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder / dead));
  EXPECT_EQ(folder.entryCount(), 4u);
}

}  // namespace
}  // namespace glintmark
