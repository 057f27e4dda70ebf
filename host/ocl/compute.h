// Buffers, programs and launches without OpenCL types in the interface.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "host/ocl/buffer_purpose.h"
#include "host/ocl/device.h"
#include "host/ocl/kernel_config.h"

namespace glintmark {

/// A device buffer.
class Buffer {
 public:
  Buffer() = default;
  /// Fresh device memory of `bytes` (at least 4 are allocated). Messages call it by its purpose, or
  /// by `what`, if given. Throws Error naming size and device.
  Buffer(Device& device, std::size_t bytes, BufferPurpose purpose, const std::string& what = "");
  /// Wraps page-aligned host memory: used in place on CPU devices (zero copy), else a device copy.
  static Buffer wrapHost(Device& device, void* data, std::size_t bytes, BufferPurpose purpose,
                         const std::string& what = "");

  /// Memory of the host's that nobody else changes: on CPU devices it becomes the buffer's and
  /// lives as long, others get a copy. Large ones begin on a page.
  static Buffer take(Device& device, std::shared_ptr<void> memory, std::size_t bytes,
                     BufferPurpose purpose, const std::string& what = "");

  /// Host to device; returns wall time [ns]. For wrapped memory the source must be that memory and
  /// the call is free on devices that use it in place.
  double write(const void* source, std::size_t bytes, std::size_t offset = 0);
  /// Device to host; returns wall time [ns]. Reads and writes throw Error if the
  /// driver says that it copied and did not.
  double read(void* target, std::size_t bytes, std::size_t offset = 0) const;
  /// Every four bytes of it get this value.
  void fill(std::uint32_t word);
  void fillZero() { fill(0); }
  std::size_t bytes() const;
  bool empty() const { return !impl_; }

  struct Impl;
  Impl* impl() const { return impl_.get(); }  // for host/ocl only

 private:
  std::shared_ptr<Impl> impl_;
};

struct LaunchTimes {
  double event_ns = 0;         // kernel START to END; the wall time where those cannot be used
  double wall_ns = 0;          // enqueue to finish on the host
  bool first_enqueue = false;  // the first of its kind: wall_ns may hold compilation
};

using KernelArg = std::variant<Buffer, std::int32_t, std::uint32_t, float>;

/// One built kernel.
class Kernel {
 public:
  /// Sets all arguments, enqueues a 1-D range rounded up to `local_size` and waits. Where the
  /// device takes no groups of `local_size` for this kernel, they have a size that divides it.
  /// `global_size` 0 does nothing. PoCL compiles at the first launch of a kernel for each local
  /// size, once below and once from 2^16 work-items: these launches are marked and summed by
  /// firstEnqueueNs(). Throws Error with the kernel's name and OpenCL error.
  LaunchTimes launch(std::span<const KernelArg> args, std::size_t global_size,
                     std::size_t local_size);
  double firstEnqueueNs() const;  // sum of wall times of first launches
  /// The names of the parameters in the source, in order; empty where the device does not keep
  /// them.
  const std::vector<std::string>& parameterNames() const;
  /// Its function's name in the source.
  const std::string& name() const;

  struct Impl;
  explicit Kernel(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}
  Kernel() = default;

 private:
  std::shared_ptr<Impl> impl_;
};

/// One built program of kernels/<file>.
class Program {
 public:
  Kernel kernel(const std::string& name) const;
  /// From source or binary to a built program [ns], storing apart; 0 when it came from memory.
  double buildNs() const;
  bool fromDiskCache() const;
  const std::string& options() const;
  /// The compiled device binary as the driver gives it; on PoCL an archive. May be empty.
  std::string binary() const;

  struct Impl;
  explicit Program(std::shared_ptr<Impl> impl) : impl_(std::move(impl)) {}
  Program() = default;

 private:
  std::shared_ptr<Impl> impl_;
};

/// Builds programs from the kernel folder and keeps them in memory and on disk
/// ($GLINTMARK_CACHE_DIR, else $XDG_CACHE_HOME/glintmark, else ~/.cache/glintmark; "off" turns the
/// disk cache off, GLINTMARK_PROGRAM_CACHE=off for programs alone). The disk key covers every file
/// of the kernel folder, the options, and the device, platform and driver; corrupt or stale entries
/// are rebuilt silently, never fatal.
/// A build failure throws Error naming the file and the first error, and leaves a copy
/// of the sources, the options and the full log in a folder that the message names.
class ProgramCache {
 public:
  explicit ProgramCache(Device& device);
  /// `file` is relative to the kernel folder, e.g. "shade.cl".
  Program get(const std::string& file, const KernelConfig& config);
  /// The same with hand-made options, for probes and tests.
  Program getWithOptions(const std::string& file, const std::string& options);

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

/// $GLINTMARK_KERNELS, else kernels/ next to the executable or in the source tree.
std::string kernelFolder();

/// Measured peaks of a device, by probe.cl.
struct DevicePeaks {
  double gflops = 0;  // float FMA, two operations each
  double gbs = 0;     // bytes read + written by a triad, per ns
};
/// Takes the fastest of many launches, about 0.5 s after the first time, and checks what they
/// computed; `lanes` is the vector width to use (DeviceInfo::default_lanes for the device's own
/// peak). The device's clock is tried on launches that are long by the wall clock, and given up if
/// it makes peaks that no device has. Throws Error if the device computes a wrong answer, or if the
/// wall clock makes such a peak, too.
DevicePeaks measurePeaks(Device& device, ProgramCache& cache, int lanes);

}  // namespace glintmark
