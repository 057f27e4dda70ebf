// What is left behind, and what is said, when a kernel does not build.
#pragma once
#include <string>

#include "host/core/error.h"

namespace glintmark {

struct FailedBuild {
  std::string file;  // relative to the kernel folder
  std::string kernel_folder;
  std::string options;
  std::string log;
  std::string device;
};

/// Writes options.txt, build.log and a copy of the kernel sources to a fresh folder under the
/// system's temporary folder and returns an error of one sentence that names the kernel file, the
/// first error of the log and that folder.
Error reportFailedBuild(const FailedBuild& failed);

}  // namespace glintmark
