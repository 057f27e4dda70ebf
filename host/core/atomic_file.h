// Files that appear whole or not at all.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace glintmark {

/// A temporary file beside `target` that takes its name on commit(); without commit() it is
/// removed and the target stays as it was.
class AtomicFile {
 public:
  /// Creates the empty temporary file. Throws Error if the folder is missing or cannot be written,
  /// or if `target` exists and is not a regular file.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& tempPath() const { return temp_; }
  /// Flushes to the disk and renames. Throws Error if either fails.
  void commit();

 private:
  std::filesystem::path target_;
  std::filesystem::path temp_;
  bool committed_ = false;
};

/// Writes a whole file of text or bytes. Throws Error naming the file and the system's reason.
void writeFile(const std::filesystem::path& target, std::string_view text);

/// Reads a whole text file. Throws Error naming the file and the system's reason.
std::string readTextFile(const std::filesystem::path& path);

/// Creates `folder` with its parents and makes sure that files can be created in it. Throws Error
/// saying what stands in the way.
void requireWritableFolder(const std::filesystem::path& folder);

/// Makes sure that `file` can be written, before work is spent on what goes into it. Throws Error
/// like AtomicFile.
void requireWritableFile(const std::filesystem::path& file);

/// Appends `text` to a file descriptor, all of it. Throws Error naming `path`.
void writeAll(int descriptor, std::string_view text, const std::filesystem::path& path);

}  // namespace glintmark
