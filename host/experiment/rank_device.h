// Which device of its machine each rank opens.
#pragma once
#include <string>

#include "host/experiment/session.h"

namespace glintmark {

/// Of all ranks: the selector of the device that this one opens; that of `common` where there is
/// one rank. Unless quiet, the first says which share a processor. Throws as openDevice() does.
std::string rankDevice(const CommonOptions& common);

/// Of all ranks: throws Error if some rank has another kind of device or driver than the first.
void requireOneKind(const DeviceInfo& info);

}  // namespace glintmark
