// Where and when a run was made.
#pragma once
#include <ctime>
#include <optional>
#include <span>
#include <string>

#include "host/report/record/record.h"

namespace glintmark {

/// Date (UTC, ISO 8601; that of $SOURCE_DATE_EPOCH where it is set), program version, command line,
/// processor model, cores and memory that this process may use, and the machine's state; the device
/// fields are left for the caller.
RunInfo describeHost(std::span<const char* const> command_line);

/// The date of $SOURCE_DATE_EPOCH, for files that are to be the same twice; nothing where it is not
/// set. Throws Error if it is no number of seconds since 1970.
/// https://reproducible-builds.org/specs/source-date-epoch/
std::optional<std::time_t> sourceDate();

/// `git describe` style version of the source the program was built from: short hash, "-dirty" if
/// it had changes, "unknown" outside a git checkout.
std::string gitVersion();

/// Memory that this process can still take [bytes]; 0 if the system does not say.
unsigned long long availableMemoryBytes();

}  // namespace glintmark
