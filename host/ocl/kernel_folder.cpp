#include "host/ocl/kernel_folder.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <system_error>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/ocl/compute.h"
#include "host/ocl/driver_cache.h"

namespace glintmark {
namespace fs = std::filesystem;

std::vector<fs::path> kernelFiles(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    const fs::path extension = it->path().extension();
    if (extension == ".cl" || extension == ".clh" || extension == ".h") files.push_back(it->path());
  }
  if (error)
    throw Error(
        fmt::format("cannot list the kernel folder '{}': {}", folder.string(), error.message()));
  std::ranges::sort(files);
  return files;
}

std::uint64_t hashKernels(const fs::path& folder) {
  std::uint64_t hash = fnv1a("");
  for (const fs::path& file : kernelFiles(folder)) {
    const std::string text = readFile(file);
    hash =
        fnv1a(fmt::format("{}:{}:", file.lexically_relative(folder).string(), text.size()), hash);
    hash = fnv1a(text, hash);
  }
  return hash;
}

std::uint64_t KernelHash::get() {
  std::string stamp;
  for (const fs::path& file : kernelFiles(folder_)) {
    struct stat status = {};
    if (::stat(file.c_str(), &status) != 0) status = {};
    stamp += fmt::format("{}:{}:{}:{}:{}.{}:{}.{}\n", file.string(), status.st_dev, status.st_ino,
                         status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec,
                         status.st_ctim.tv_sec, status.st_ctim.tv_nsec);
  }
  if (stamp != stamp_) {
    hash_ = hashKernels(folder_);
    stamp_ = std::move(stamp);
  }
  return hash_;
}

IncludePath::IncludePath(const std::string& folder) : folder_(folder) {
  // Drivers take options apart at blanks, some like a shell.
  if (folder.find_first_of(" \t\n\"'\\`$;&|<>()*?[]{}#!") == std::string::npos) return;
  std::error_code error;
  const fs::path link =
      fs::path(folderWithoutBlanks()) / fmt::format("glintmark-kernels-{}", ::getpid());
  fs::remove(link, error);
  fs::create_directory_symlink(fs::absolute(folder), link, error);
  if (error)
    throw Error(fmt::format(
        "the kernel folder '{}' has a blank or a quote in its path and no link to it could "
        "be made: {}",
        folder, error.message()));
  link_ = link.string();
}

IncludePath::~IncludePath() {
  std::error_code error;
  if (!link_.empty()) fs::remove(link_, error);
}

std::string kernelFolder() {
  if (const char* chosen = std::getenv("GLINTMARK_KERNELS"); chosen && *chosen) {
    if (!fs::is_directory(chosen))
      throw Error(fmt::format("GLINTMARK_KERNELS is '{}', which is not a folder", chosen));
    return chosen;
  }
  std::error_code error;
  const fs::path bin = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const fs::path& folder : {bin.parent_path() / "share" / "glintmark" / "kernels",
                                 bin / "kernels", fs::path(GLINTMARK_KERNEL_SOURCE_DIR)})
    if (fs::is_directory(folder, error)) return folder.string();
  throw Error("the kernel folder was not found; set GLINTMARK_KERNELS to the folder of shade.cl");
}

}  // namespace glintmark
