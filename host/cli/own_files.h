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

/// What the command line names of what makes a scene: its file, a mesh, values of --set. Files that
/// a scene file names are not among them.
std::vector<std::string> sceneInputs(const CommonOptions& common, const std::string& scene);

}  // namespace glintmark
