// Where and when a run was made.
#pragma once
#include <span>
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

/// Date (UTC, ISO 8601), program version, command line, processor model, cores and memory that this
/// process may use, and the machine's state; the device fields are left for the caller.
RunInfo describeHost(std::span<const char* const> command_line);

/// `git describe` style version of the source the program was built from: short hash, "-dirty" if
/// it had changes, "unknown" outside a git checkout.
std::string gitVersion();

/// Memory that this process can still take [bytes]; 0 if the system does not say.
unsigned long long availableMemoryBytes();

}  // namespace glintmark
