#include "host/core/disk_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <system_error>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/fnv1a.h"

namespace glintmark {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "glintmark.cache/1\n";

void append(std::string& out, std::uint64_t value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

// Takes pieces off the front of an entry; every take fails for good once one has failed.
class EntryReader {
 public:
  explicit EntryReader(std::string_view entry) : rest_(entry) {}

  std::string_view take(std::uint64_t size) {
    if (size > rest_.size()) ok_ = false;
    if (!ok_) return {};
    const std::string_view piece = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return piece;
  }

  std::uint64_t takeNumber() {
    std::uint64_t value = 0;
    const std::string_view piece = take(sizeof value);
    if (ok_) std::memcpy(&value, piece.data(), sizeof value);
    return value;
  }

  bool atEnd() const { return ok_ && rest_.empty(); }

 private:
  std::string_view rest_;
  bool ok_ = true;
};

const char* nonEmptyEnv(const char* name) {
  const char* value = std::getenv(name);
  return value && *value ? value : nullptr;
}

}  // namespace

DiskCache DiskCache::fromEnvironment() {
  DiskCache cache;
  if (const char* chosen = nonEmptyEnv("GLINTMARK_CACHE_DIR")) {
    if (std::string_view(chosen) != "off") cache.folder_ = chosen;
  } else if (const char* xdg = nonEmptyEnv("XDG_CACHE_HOME")) {
    cache.folder_ = fs::path(xdg) / "glintmark";
  } else if (const char* home = nonEmptyEnv("HOME")) {
    cache.folder_ = fs::path(home) / ".cache" / "glintmark";
  }
  return cache;
}

bool DiskCache::isOurs() const {
  if (folder_.empty()) return false;
  const int descriptor = open(folder_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct stat status = {};
  bool ours = fstat(descriptor, &status) == 0 && status.st_uid == geteuid();
  if (ours && (status.st_mode & (S_IRWXG | S_IRWXO)) != 0) ours = fchmod(descriptor, S_IRWXU) == 0;
  close(descriptor);
  return ours;
}

fs::path DiskCache::entryPath(const std::string& name) const {
  return folder_ / fmt::format("{:016x}.bin", fnv1a(name));
}

std::optional<std::string> DiskCache::load(const std::string& name, const std::string& key) const {
  if (!isOurs()) return std::nullopt;
  std::string entry;
  try {
    struct stat status = {};
    const fs::path file = entryPath(name);
    if (lstat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode) || status.st_uid != geteuid())
      return std::nullopt;
    entry = readFile(entryPath(name), FileRole::kOwn);
  } catch (const Error&) {
    return std::nullopt;
  }
  EntryReader reader(entry);
  if (reader.take(kMagic.size()) != kMagic) return std::nullopt;
  if (reader.take(reader.takeNumber()) != key) return std::nullopt;
  const std::uint64_t size = reader.takeNumber();
  const std::uint64_t hash = reader.takeNumber();
  const std::string_view binary = reader.take(size);
  if (!reader.atEnd() || binary.empty() || fnv1a(binary) != hash) return std::nullopt;
  // In place: entries may be gigabytes.
  entry.erase(0, entry.size() - size);
  return entry;
}

void DiskCache::store(const std::string& name, const std::string& key,
                      const std::string& binary) const {
  store(name, key, binary, {});
}

void DiskCache::store(const std::string& name, const std::string& key, std::string_view first,
                      std::string_view second) const {
  if (folder_.empty() || first.empty()) return;
  std::string head(kMagic);
  append(head, key.size());
  head += key;
  append(head, first.size() + second.size());
  append(head, fnv1a(second, fnv1a(first)));

  std::error_code error;
  fs::create_directories(folder_.parent_path(), error);
  // A umask may take even the owner's rights.
  if (mkdir(folder_.c_str(), S_IRWXU) == 0) chmod(folder_.c_str(), S_IRWXU);
  if (!isOurs()) return;
  try {
    writeFile(entryPath(name), {head, first, second}, Durability::kUnsynced);
  } catch (const Error&) {
    // The next run computes it again.
  }
}

}  // namespace glintmark
