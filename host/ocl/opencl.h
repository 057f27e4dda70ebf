// The only header of the project that includes OpenCL, and what hides behind the public interfaces.
#pragma once
#define CL_HPP_ENABLE_EXCEPTIONS
#define CL_HPP_TARGET_OPENCL_VERSION 120
#define CL_HPP_MINIMUM_OPENCL_VERSION 120
#include <CL/opencl.hpp>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "host/core/error.h"
#include "host/core/last_words.h"
#include "host/ocl/compute.h"
#include "host/ocl/device.h"
#include "host/ocl/device_clock.h"

namespace glintmark {

/// Name of an OpenCL error code, e.g. "CL_OUT_OF_RESOURCES" for -5; "OpenCL error -N" if unknown.
std::string openClErrorName(cl_int code);

/// The project's error for a failed OpenCL call: "<doing> failed with <name> in <call>".
Error openClError(const std::string& doing, const cl::Error& error);

/// Counts the bytes of a device's buffers; outlives the device while buffers do.
class BufferLedger {
 public:
  void add(BufferPurpose purpose, std::size_t bytes);
  void remove(BufferPurpose purpose, std::size_t bytes);
  BufferUse use() const;
  void resetPeaks();

 private:
  mutable std::mutex mutex_;
  BufferUse use_;
};

struct Device::Impl {
  DeviceInfo info;
  cl::Device device;
  cl::Context context;
  cl::CommandQueue queue;  // in order, profiling where the device can
  std::shared_ptr<BufferLedger> ledger = std::make_shared<BufferLedger>();
  std::shared_ptr<DeviceClock> clock{};
};

struct Buffer::Impl {
  ~Impl() {
    if (ledger) ledger->remove(purpose, bytes);
    const DriverCall call("releasing " + what);
    buffer = cl::Buffer();
    queue = cl::CommandQueue();
  }
  std::shared_ptr<void> memory{};  // what `buffer` uses in place, where that is ours
  cl::Buffer buffer;
  cl::CommandQueue queue;
  std::shared_ptr<DeviceClock> clock{};
  std::size_t bytes = 0;
  BufferPurpose purpose = BufferPurpose::kProbe;
  std::string what, device_name{};       // as messages call them
  const void* host = nullptr;            // what `buffer` uses in place
  std::shared_ptr<BufferLedger> ledger;  // set once the buffer is there
};

struct Kernel::Impl {
  ~Impl() {
    const DriverCall call("releasing kernel " + name);
    kernel = cl::Kernel();
    queue = cl::CommandQueue();
  }
  cl::Kernel kernel;
  cl::CommandQueue queue;
  std::string name;
  std::set<std::pair<std::size_t, bool>> launched;  // local size, small grid
  double first_enqueue_ns = 0;
  std::vector<std::string> parameter_names{};
  std::shared_ptr<DeviceClock> clock{};
  std::size_t max_local_size = 0;  // what the device takes for this kernel; 0: not known
};

/// A program for one device; shared by all Program handles that the cache gave out.
struct BuiltProgram {
  ~BuiltProgram() {
    const DriverCall call("releasing " + file);
    kernels.clear();
    program = cl::Program();
    queue = cl::CommandQueue();
  }
  cl::Program program;
  cl::Device device;
  cl::CommandQueue queue;
  std::string file;
  std::string options;
  std::map<std::string, std::shared_ptr<Kernel::Impl>> kernels;
  std::shared_ptr<DeviceClock> clock{};
  std::size_t max_local_size = 0;  // of the device; 0: not known
};

struct Program::Impl {
  std::shared_ptr<BuiltProgram> built;
  double build_ns = 0;
  bool from_disk_cache = false;
};

/// What the event of a finished command says; nothing if the driver refuses.
std::optional<EventTimes> eventTimes(const cl::Event& event);

/// Keeps a finished command for the trace, if its times make sense and the device's clock is in
/// use; the host enqueued it after `host_begin_ns` by traceNowNs().
void traceEvent(const char* category, const std::string& name, const cl::Event& event,
                std::int64_t host_begin_ns, const DeviceClock& clock);

/// Compiled binary of a built program for its device; empty if the driver gives none.
std::string programBinary(const cl::Program& program);

}  // namespace glintmark
