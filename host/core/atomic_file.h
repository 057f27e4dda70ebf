// Whole files: written, they appear whole or not at all.
#pragma once
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace glintmark {

/// What is left of a file that was written just before the machine stops: with kSynced all of it or
/// the file before it; with kUnsynced perhaps part of it, for what can be made again.
enum class Durability { kSynced, kUnsynced };

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
  /// Flushes to the disk, unless told not to, and renames. Throws Error if either fails.
  void commit(Durability durability = Durability::kSynced);

 private:
  void sync() const;

  std::filesystem::path target_;
  std::filesystem::path temp_;
  bool committed_ = false;
};

/// Writes a whole file of text or bytes. Throws Error naming the file and the system's reason.
void writeFile(const std::filesystem::path& target, std::string_view text);
/// The same of pieces that follow each other.
void writeFile(const std::filesystem::path& target, std::initializer_list<std::string_view> pieces,
               Durability durability);

/// Reads a whole file of text or bytes. Throws Error naming the file and the system's reason.
std::string readFile(const std::filesystem::path& path);

/// Creates `folder` with its parents and makes sure that files can be created in it. Throws Error
/// saying what stands in the way.
void requireWritableFolder(const std::filesystem::path& folder);

/// Makes sure that `file` can be written, before work is spent on what goes into it. Throws Error
/// like AtomicFile.
void requireWritableFile(const std::filesystem::path& file);

/// Appends `text` to a file descriptor, all of it. Throws Error naming `path`.
void writeAll(int descriptor, std::string_view text, const std::filesystem::path& path);

}  // namespace glintmark
