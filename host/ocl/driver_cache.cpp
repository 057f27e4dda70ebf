#include "host/ocl/driver_cache.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <system_error>

namespace glintmark {
namespace {

namespace fs = std::filesystem;

const char* nonEmpty(const char* variable) {
  const char* value = std::getenv(variable);
  return value && *value ? value : nullptr;
}

struct Wanted {
  fs::path folder;
  bool chosen = false;  // by name, for PoCL
};

// Where PoCL 3 to 7 look, in this order. An empty home is one to them, the root folder; an empty
// POCL_CACHE_DIR makes them abort.
Wanted poclFolder() {
  if (const char* chosen = nonEmpty("POCL_CACHE_DIR")) return {chosen, true};
  unsetenv("POCL_CACHE_DIR");
  if (const char* caches = nonEmpty("XDG_CACHE_HOME")) return {fs::path(caches) / "pocl/kcache"};
  if (const char* home = std::getenv("HOME")) return {fs::path("/") / home / ".cache/pocl/kcache"};
  return {"/tmp/pocl/kcache"};
}

// What PoCL compiles is loaded as code: nobody else may write it unless the user says so, and the
// file system has to allow it.
std::string faultOf(const Wanted& wanted) {
  std::error_code error;
  fs::create_directories(wanted.folder, error);
  if (error || access(wanted.folder.c_str(), W_OK | X_OK) != 0) return "cannot be written";
  struct statvfs system = {};
  if (statvfs(wanted.folder.c_str(), &system) == 0 && (system.f_flag & ST_NOEXEC) != 0)
    return "is on a file system whose files cannot be executed";
  struct stat owner = {};
  if (!wanted.chosen && stat(wanted.folder.c_str(), &owner) == 0 && owner.st_uid != geteuid())
    return "belongs to another user";
  return "";
}

// Removed by the process that made it, not by those that it forks.
class TemporaryCache {
 public:
  ~TemporaryCache() { remove(); }

  void remove() {
    std::error_code error;
    if (!folder_.empty() && owner_ == getpid()) fs::remove_all(folder_, error);
  }

  std::string make() {
    std::string folder = folderWithoutBlanks() + "/glintmark-pocl-XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) return "";
    folder_ = folder;
    owner_ = getpid();
    return folder;
  }

 private:
  fs::path folder_;
  pid_t owner_ = 0;
};

TemporaryCache& temporaryCache() {
  static TemporaryCache cache;
  return cache;
}

}  // namespace

std::string folderWithoutBlanks() {
  for (const char* folder : {nonEmpty("TMPDIR"), "/tmp", "/var/tmp", "/dev/shm"})
    if (folder && std::string(folder).find_first_of(" \t") == std::string::npos &&
        faultOf({folder, true}).empty())
      return folder;
  return "/tmp";
}

std::string prepareDriverCache() try {
  static bool done = false;
  if (done) return "";
  done = true;
  setenv("PATH", "/usr/local/bin:/usr/bin:/bin",
         0);  // without any, PoCL finds no linker and aborts
  const Wanted wanted = poclFolder();
  const std::string fault = faultOf(wanted);
  if (fault.empty()) return "";
  const std::string made = temporaryCache().make();
  if (made.empty())
    return fmt::format(
        "PoCL's cache '{}' {}, nor is there a temporary folder: set POCL_CACHE_DIR to "
        "a folder that can be written",
        wanted.folder.string(), fault);
  std::at_quick_exit([] { temporaryCache().remove(); });
  setenv("POCL_CACHE_DIR", made.c_str(), 1);
  return fmt::format(
      "PoCL's cache '{}' {}, a temporary one is used; POCL_CACHE_DIR chooses another",
      wanted.folder.string(), fault);
} catch (const fs::filesystem_error&) {
  return "";
}

}  // namespace glintmark
