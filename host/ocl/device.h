// OpenCL devices: choosing one, its facts, its context and queue.
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/ocl/buffer_purpose.h"

namespace glintmark {

struct DeviceInfo {
  int index = 0;  // over all platforms, in the order the loader lists them
  std::string name, vendor, platform, platform_version, driver_version, opencl_c_version;
  std::string type;  // "CPU", "GPU", "accelerator"
  unsigned compute_units = 0;
  unsigned max_clock_mhz = 0;
  unsigned preferred_float_width = 1;
  unsigned max_work_group_size = 1;
  unsigned long long global_mem_bytes = 0, max_alloc_bytes = 0, local_mem_bytes = 0;
  unsigned long long cache_bytes = 0;  // of global memory, all cores together
  bool is_cpu = false;
  bool host_unified_memory = false;
  bool correctly_rounded_divide_sqrt = false;
  int default_lanes = 1;  // W for wide kernels: 16, 8, 4 or 1
};

/// All devices of all platforms; empty if there is no OpenCL platform at all (never throws for it).
std::vector<DeviceInfo> listDevices();

/// Bytes of device buffers: held now, and at most at once since the peaks were last reset.
struct BufferBytes {
  std::size_t held = 0, peak = 0;
};

/// What was really allocated on a device, by purpose.
struct BufferUse {
  std::map<BufferPurpose, BufferBytes> by_purpose;
  BufferBytes total;
};

/// An opened device with context and profiling in-order queue. OpenCL types stay behind
/// host/ocl/opencl.h, so this header does not include them.
class Device {
 public:
  /// `selector`: empty = first GPU, else first device; a number = index; else a case-insensitive
  /// substring of the device or platform name. Throws DeviceError listing what there is.
  explicit Device(const std::string& selector = "");
  ~Device();
  Device(Device&&) noexcept;
  Device& operator=(Device&&) noexcept;

  const DeviceInfo& info() const;

  /// Buffers of this device, those that wrap host memory included. Safe from any thread.
  BufferUse bufferUse() const;
  /// Forgets what has been freed: peaks become what is held now.
  void resetBufferPeaks();

  struct Impl;
  Impl& impl() { return *impl_; }  // for host/ocl only

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace glintmark
