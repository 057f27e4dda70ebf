// What a run reads and what it writes: never one file.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "host/core/error.h"

namespace glintmark {

/// An output that would be written over an input.
class OverwriteError : public Error {
 public:
  using Error::Error;
};

/// While one lives, inputs and announced outputs are remembered, and none of the former is written
/// over. Without one, as in tests that write what they read, nothing is.
class InputGuard {
 public:
  InputGuard();
  ~InputGuard();
  InputGuard(const InputGuard&) = delete;
  InputGuard& operator=(const InputGuard&) = delete;
};

struct OutputFile {
  const char* option;  // that names it
  std::string file;    // empty for none
};

/// Before work is spent: throws Error naming the option for an output that cannot be written, that
/// is another one's file, or an input; if one of them is read as an input later, that throws.
void announceOutputs(const std::vector<OutputFile>& outputs);

/// Remembers an input, which is open. Throws OverwriteError if it is an announced output.
void noteInput(const std::filesystem::path& path, dev_t device, ino_t inode);
/// Throws OverwriteError if `target` is there and was read as an input.
void requireNoInput(const std::filesystem::path& target);
/// What was announced is there now, and may be read.
void noteWritten(const std::filesystem::path& target);

}  // namespace glintmark
