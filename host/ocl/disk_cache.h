// Compiled programs on disk. Nothing here ever fails: a cache that cannot be read or written is
// a cache that misses.
#pragma once
#include <filesystem>
#include <optional>
#include <string>

namespace glintmark {

/// A folder of entries, one file per key:
///   "glintmark.program/1\n", key length, key, binary length, FNV-1a of the binary, binary;
/// lengths and hash as 8 bytes in the machine's order. The whole key is stored, so that two keys
/// that fall on one file name only replace each other.
class DiskCache {
 public:
  /// $GLINTMARK_CACHE_DIR, else $XDG_CACHE_HOME/glintmark, else ~/.cache/glintmark; "off" or no
  /// home turns the cache off.
  static DiskCache fromEnvironment();

  /// The binary stored under `key`; nothing if absent, truncated or damaged.
  std::optional<std::string> load(const std::string& key) const;
  /// Stores through a temporary file and a rename, so that a reader never sees half an entry.
  void store(const std::string& key, const std::string& binary) const;
  void remove(const std::string& key) const;

 private:
  std::filesystem::path entryPath(const std::string& key) const;
  std::filesystem::path folder_;  // empty: off
};

}  // namespace glintmark
