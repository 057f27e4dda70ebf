// What glint methods look up in a buffer: GLINT_TABLE of kernels/glint/glint.clh.
#pragma once
#include <optional>

#include "host/ocl/compute.h"
#include "host/ocl/kernel_config.h"

namespace glintmark {

/// The table of a program's glint method, on the device; none for methods that have none.
std::optional<Buffer> glintTable(Device& device, const KernelConfig& config, BufferPurpose purpose);

}  // namespace glintmark
