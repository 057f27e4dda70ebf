// One run at a time in a results folder.
#pragma once
#include <filesystem>
#include <string>

namespace glintmark {

/// Holds the file `.lock` in a folder locked (flock) as long as it lives. The system frees the lock
/// of a program that was killed, so a file left behind stands in nobody's way; the next holder
/// takes it away.
class FolderLock {
 public:
  /// Throws Error naming the process that holds the lock, or if the file cannot be made or is
  /// none of a lock. On file
  /// systems without locks it does nothing.
  explicit FolderLock(const std::filesystem::path& folder);
  /// The same with a lock file of another name; `what` is locked, `advice` is what else to do.
  FolderLock(const std::filesystem::path& file, const std::string& what, const std::string& advice);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace glintmark
