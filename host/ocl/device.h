// OpenCL devices: choosing one, its facts, its context and queue.
#pragma once
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "host/ocl/buffer_purpose.h"

namespace glintmark {

/// Facts that a driver refuses to give, or gives as 0, are unknown: 0 or empty here.
struct DeviceInfo {
  int index = 0;  // over all platforms, in the order the loader lists them
  std::string name, vendor, platform, platform_version, driver_version, opencl_c_version;
  std::string type;  // "CPU", "GPU", "accelerator"
  unsigned compute_units = 0;
  unsigned max_clock_mhz = 0;
  unsigned preferred_float_width = 0;
  std::size_t max_work_group_size = 0;  // of any kernel in one dimension
  unsigned long long global_mem_bytes = 0, max_alloc_bytes = 0, local_mem_bytes = 0;
  unsigned long long cache_bytes = 0;  // of global memory, all cores together
  unsigned long long timer_resolution_ns = 0;
  bool is_cpu = false;
  bool host_unified_memory = false;
  bool correctly_rounded_divide_sqrt = false;
  int default_lanes = 1;  // W for wide kernels: 16, 8, 4 or 1
  std::string problem;    // why it cannot run kernels; empty if nothing is known to be wrong
  std::vector<std::string> refused;  // names of the facts that the driver refused
};

/// A platform of the OpenCL loader with its devices.
struct PlatformInfo {
  std::string name, version, vendor;
  std::string problem;  // why it offers no devices; empty if it does
  std::vector<DeviceInfo> devices;
};

/// What the OpenCL loader finds. Never throws for what is missing or broken.
struct PlatformList {
  std::vector<PlatformInfo> platforms;
  std::string problem;  // of the loader as a whole: no platform is installed, or it fails
  /// Drivers that are registered with the loader but cannot be loaded, "FILE: why".
  std::vector<std::string> broken_drivers;
};
PlatformList listPlatforms();

/// All devices of all platforms; empty if there is no OpenCL platform at all (never throws for it).
std::vector<DeviceInfo> listDevices();

/// Indices of the device that `selector` means (see Device) and of those that are like it, of its
/// name and platform, and without a problem; that one first. Throws DeviceError like Device.
std::vector<int> devicesLike(const std::string& selector);

/// Which clock times kernels: the device's while it makes sense, always the device's, or the
/// wall's.
enum class TimerChoice { kAuto, kDevice, kWall };
/// The one that is in use.
enum class Timer { kDevice, kWall };
/// "device" or "wall", as in records.
const char* timerName(Timer timer);

class DeviceClock;

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
  /// `selector`: empty = first GPU, else first device, that has no problem; a number = index; else,
  /// in any case, the name of the device or a part of its or its platform's name that no other
  /// device has. Throws DeviceError listing what there is, and what is wrong with each.
  explicit Device(const std::string& selector = "", TimerChoice timer = TimerChoice::kAuto);
  ~Device();
  Device(Device&&) noexcept;
  Device& operator=(Device&&) noexcept;

  const DeviceInfo& info() const;

  /// Some of this device's compute units as a device of its own, with context and queue; clocks and
  /// buffers are its own, too. Throws DeviceError if it has not so many or the driver cannot divide
  /// it.
  Device part(unsigned compute_units) const;

  /// Buffers of this device, those that wrap host memory included. Safe from any thread.
  BufferUse bufferUse() const;
  /// Forgets what has been freed: peaks become what is held now.
  void resetBufferPeaks();

  /// Judges the device's times, and says which clock is in use.
  DeviceClock& clock() const;

  struct Impl;
  Impl& impl() { return *impl_; }  // for host/ocl only

 private:
  explicit Device(std::unique_ptr<Impl> impl);
  void open(TimerChoice timer);

  std::unique_ptr<Impl> impl_;
};

}  // namespace glintmark
