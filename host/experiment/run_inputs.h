// What a run's figures depend on beside the program.
#pragma once
#include <string>

#include "host/experiment/session.h"

namespace glintmark {

/// A hash of the contents of all kernels, of the tables that are fitted once, of all scenes of the
/// scene folder and of the meshes that the options name.
std::string hashInputs(const CommonOptions& common, const std::vector<std::string>& scenes);

}  // namespace glintmark
