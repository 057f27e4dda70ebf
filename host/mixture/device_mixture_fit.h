// The fit of Gaussian mixtures of normals on an OpenCL device. [TAN05] Sect. 4.1
#pragma once
#include <functional>

#include "host/mixture/normal_mixture.h"
#include "host/ocl/compute.h"

namespace glintmark {

/// What fitNormalMixtures does, on `device` by kernels of `lanes` lanes: the same levels, batches,
/// neighbours and limits. Each texel stops on its own where the host's stop in blocks; tighter
/// tolerances bring the two closer. Same bits for any number of lanes. `options.threads` means
/// nothing here. Throws Error for options out of range, a bad map, an order other than kColours,
/// and a chain of 2^31 numbers or more; kExitCheckFailed where the device's answer cannot be right.
NormalMixtures fitMixturesOnDevice(Device& device, ProgramCache& cache, int lanes,
                                   const NormalMap& map, const MixtureOptions& options = {},
                                   const std::function<void(double)>& progress = {});

}  // namespace glintmark
