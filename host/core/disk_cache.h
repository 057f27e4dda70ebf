// What took long to compute, on disk: compiled programs, fitted mixtures. Nothing here ever fails:
// a cache that cannot be read or written is a cache that misses.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace glintmark {

/// A folder of entries, one file per name:
///   "glintmark.cache/1\n", key length, key, binary length, FNV-1a of the binary, binary;
/// lengths and hash as 8 bytes in the machine's order. An entry is good for its whole key only; a
/// new key under the same name (newer sources, say) replaces it, so that the folder stays small.
/// Entries hold code that is run, so the folder is its owner's alone (0700); one that belongs to
/// someone else is not used.
class DiskCache {
 public:
  /// $GLINTMARK_CACHE_DIR, else $XDG_CACHE_HOME/glintmark, else ~/.cache/glintmark; "off" or no
  /// home turns the cache off.
  static DiskCache fromEnvironment();
  /// Keeps nothing.
  static DiskCache off() { return {}; }

  bool isOff() const { return folder_.empty(); }
  /// The binary stored under `name` for `key`; nothing if absent, truncated, damaged or stale.
  std::optional<std::string> load(const std::string& name, const std::string& key) const;
  /// Stores through a temporary file and a rename, so that a reader never sees half an entry.
  void store(const std::string& name, const std::string& key, const std::string& binary) const;
  /// The same of a binary in two pieces, which may be gigabytes.
  void store(const std::string& name, const std::string& key, std::string_view first,
             std::string_view second) const;

 private:
  /// Is there a folder, and ours? Takes it from group and others where it is open to them.
  bool isOurs() const;
  std::filesystem::path entryPath(const std::string& name) const;
  std::filesystem::path folder_;  // empty: off
};

}  // namespace glintmark
