// Whole files: written, they appear whole or not at all.
#pragma once
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <string>
#include <string_view>

namespace glintmark {

/// What is left of a file that was written just before the machine stops: with kSynced all of it or
/// the file before it; with kUnsynced perhaps part of it, for what can be made again.
enum class Durability { kSynced, kUnsynced };

/// A temporary file beside `target` that takes its name on commit(); without commit() it is
/// removed and the target stays as it was. Its name cannot be guessed, and what has it already, a
/// symbolic link too, is left alone.
class AtomicFile {
 public:
  /// Creates the empty temporary file, and removes those that killed runs have left in the folder.
  /// Throws Error if the folder is missing or cannot be written,
  /// if `target` exists and is not a regular file, or if it was read as an input.
  explicit AtomicFile(const std::filesystem::path& target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Open for writing as long as this lives.
  int descriptor() const { return descriptor_; }
  /// Flushes to the disk, unless told not to, and renames. Throws Error if either fails.
  void commit(Durability durability = Durability::kSynced);

 private:
  void sync() const;

  std::filesystem::path target_;
  std::filesystem::path temp_;
  int descriptor_ = -1;  // locked: whoever finds the file can see that its writer lives
  bool committed_ = false;
};

/// Removes the temporary files of AtomicFile that processes which are no more have left in a
/// folder.
void removeAbandonedFiles(const std::filesystem::path& folder);

/// Writes a whole file of text or bytes. Throws Error naming the file and the system's reason.
void writeFile(const std::filesystem::path& target, std::string_view text);
/// The same of pieces that follow each other.
void writeFile(const std::filesystem::path& target, std::initializer_list<std::string_view> pieces,
               Durability durability);

/// Whose a file is that is read: an input is the user's, and no output may be written over it
/// (output_files.h); what the program keeps for itself it also writes again.
enum class FileRole { kInput, kOwn };

/// A regular file opened for reading: a device, a pipe, a socket or a folder is refused at once,
/// since it may have no end or never answer. Throws Error naming the file and the reason, or an
/// output that is the file.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path, FileRole role = FileRole::kInput);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// 0 for the files of /proc, which have bytes all the same.
  std::uint64_t sizeBytes() const { return size_bytes_; }
  /// Up to `count` bytes; fewer only at the end of the file.
  std::size_t read(char* bytes, std::size_t count);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  std::uint64_t size_bytes_ = 0;
};

/// Reads a whole file of text or bytes. Throws Error like InputFile, and for more bytes than memory
/// is free.
std::string readFile(const std::filesystem::path& path, FileRole role = FileRole::kInput);

/// Creates `folder` with its parents and makes sure that files can be created in it. Throws Error
/// saying what stands in the way.
void requireWritableFolder(const std::filesystem::path& folder);

/// Makes sure that `file` can be written, before work is spent on what goes into it. Throws Error
/// like AtomicFile.
void requireWritableFile(const std::filesystem::path& file);

/// Appends `text` to a file descriptor, all of it. Throws Error naming `path`.
void writeAll(int descriptor, std::string_view text, const std::filesystem::path& path);

}  // namespace glintmark
