// Whether a device computes at all, before anything is measured or drawn on it.
#pragma once
#include "host/ocl/compute.h"

namespace glintmark {

/// Moves a megabyte to the device, has kernels/probes/probe.cl add and multiply it at `lanes`, and
/// holds every value that comes back against its own, in milliseconds beside its build.
/// Throws DeviceError if one differs: integers below 2^24 are exact, whatever the device rounds.
void tryDevice(Device& device, int lanes);

}  // namespace glintmark
