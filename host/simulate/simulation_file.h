// Simulations on disk, to carry on with.
#pragma once
#include <string>

#include "host/simulate/simulation.h"

namespace glintmark {

/// The settings but for the number of rays in one line, the same for the same settings only.
std::string describeSettings(const SimulationSettings& settings);

/// A whole file: three lines (format, settings, rays so far), then the histogram's words as 64-bit
/// little-endian counts.
std::string packSimulation(const Simulation& simulation);

/// Inverse of packSimulation. `source` names the text in errors: not such a file, cut off, of other
/// settings than `settings`, or with more rays than they ask for.
Simulation unpackSimulation(const std::string& text, const SimulationSettings& settings,
                            const std::string& source);

}  // namespace glintmark
