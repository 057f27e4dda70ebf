// Where the kernel sources are, and their fingerprint.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host/core/fnv1a.h"

namespace glintmark {

/// The .cl, .clh and .h files of `folder`, sorted by name. Throws Error if it cannot be listed.
std::vector<std::filesystem::path> kernelFiles(const std::filesystem::path& folder);

/// Hash of the names and contents of all kernelFiles(folder).
std::uint64_t hashKernels(const std::filesystem::path& folder);

/// hashKernels of one folder, again and again: files are read again only if one of them was
/// replaced, written to, added or removed.
class KernelHash {
 public:
  explicit KernelHash(std::filesystem::path folder) : folder_(std::move(folder)) {}
  /// The hash of what the files hold now. Throws Error if the folder cannot be listed or read.
  std::uint64_t get();

 private:
  std::filesystem::path folder_;
  std::string stamp_;  // names, places on the disk, sizes and times of the files
  std::uint64_t hash_ = 0;
};

/// A path of `folder` that can stand in build options, which are split at blanks: the folder
/// itself, or a link in the system's temporary folder that lives as long as this object.
class IncludePath {
 public:
  explicit IncludePath(const std::string& folder);
  ~IncludePath();
  IncludePath(const IncludePath&) = delete;
  IncludePath& operator=(const IncludePath&) = delete;

  const std::string& path() const { return link_.empty() ? folder_ : link_; }

 private:
  std::string folder_;
  std::string link_;
};

}  // namespace glintmark
