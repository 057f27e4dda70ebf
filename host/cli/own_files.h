// Each file that a command writes is its own, and none that it reads.
#pragma once
#include <string>
#include <vector>

#include "host/experiment/session.h"

namespace glintmark {

struct OutputFile {
  const char* option;  // that names it
  std::string file;    // empty for none
};

/// Throws Error naming the option for an output that is another one's file, or one of `inputs`;
/// these may end in #LAYER, and need not be files at all.
void requireOwnFiles(const std::vector<OutputFile>& outputs,
                     const std::vector<std::string>& inputs = {});

/// What may be a file of those that make a scene: its own, a mesh, values of --set and texts of its
/// file. What a mesh file names is not among them.
std::vector<std::string> sceneInputs(const CommonOptions& common, const std::string& scene);

}  // namespace glintmark
