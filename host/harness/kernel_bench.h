// The device that kernels run on over arrays, with its programs.
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host/ocl/compute.h"
#include "host/ocl/device.h"
#include "host/ocl/upload.h"

namespace glintmark {

/// An opened device and the programs that were built for it.
struct KernelBench {
  explicit KernelBench(Device opened) : device(std::move(opened)), cache(device) {}
  Device device;
  ProgramCache cache;
};

/// Work-items of a group, one number everywhere: PoCL compiles a kernel anew for each.
inline constexpr std::size_t kLocalSize = 16;

/// A kernel of kernels/<file> with the given switches of config.clh.
Kernel probeKernel(KernelBench& bench, const std::string& file, const std::string& name,
                   const std::string& switches);

/// A buffer that holds `items`, for a probe to read; messages call it `what`, if given.
template <typename T>
Buffer probeData(KernelBench& bench, const std::vector<T>& items, const std::string& what = "") {
  return upload(bench.device, items, BufferPurpose::kProbe, what);
}

/// Entries of an array of `n` such that no lane count runs past the end.
std::size_t paddedCount(std::size_t n);

}  // namespace glintmark
