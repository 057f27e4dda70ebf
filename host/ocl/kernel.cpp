#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <thread>

#include "host/core/stopwatch.h"
#include "host/core/trace.h"
#include "host/ocl/driver_visit.h"
#include "host/ocl/opencl.h"

namespace glintmark {
namespace {

// PoCL compiles a kernel at its first enqueue for each local size, once more for grids of 2^16
// work-items and more (it uses 16-bit indices below).
constexpr std::size_t kSmallGridItems = std::size_t{1} << 16;

// How long an event may say that its launch is not over after the driver said that it is.
constexpr double kEndPatience_ns = 10e9;

void setArgs(Kernel::Impl& impl, std::span<const KernelArg> args) {
  const auto wanted = impl.kernel.getInfo<CL_KERNEL_NUM_ARGS>();
  if (args.size() != wanted)
    throw Error(fmt::format("kernel '{}' takes {} arguments, but {} were given", impl.name, wanted,
                            args.size()));
  for (cl_uint i = 0; i < wanted; ++i) {
    if (const Buffer* buffer = std::get_if<Buffer>(&args[i])) {
      if (buffer->empty())
        throw Error(
            fmt::format("argument {} of kernel '{}' is an empty buffer; it must be "
                        "allocated first",
                        i, impl.name));
      impl.kernel.setArg(i, buffer->impl()->buffer);
    } else if (const auto* number = std::get_if<std::int32_t>(&args[i])) {
      impl.kernel.setArg(i, *number);
    } else if (const auto* count = std::get_if<std::uint32_t>(&args[i])) {
      impl.kernel.setArg(i, *count);
    } else {
      impl.kernel.setArg(i, std::get<float>(args[i]));
    }
  }
}

// The largest divisor of `wanted` that is at most `limit` (0: not known), so that ranges stay
// multiples of it and no work-item is added.
std::size_t fittingLocalSize(std::size_t wanted, std::size_t limit) {
  if (limit == 0 || limit >= wanted) return wanted;
  std::size_t fitting = limit;
  while (wanted % fitting != 0) --fitting;
  return fitting;
}

// Drivers refuse groups that their own limits allow, some for want of registers.
bool mayBeTooLargeAGroup(cl_int code) {
  return code == CL_INVALID_WORK_GROUP_SIZE || code == CL_INVALID_WORK_ITEM_SIZE ||
         code == CL_OUT_OF_RESOURCES;
}

// Some drivers take no range as large as they should, 32-bit devices none beyond 2^32 work-items.
bool isTooLargeARange(cl_int code) {
  return code == CL_INVALID_GLOBAL_WORK_SIZE;
}

std::optional<cl_int> statusOf(const cl::Event& event) {
  cl_int status = CL_COMPLETE;
  if (clGetEventInfo(event(), CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof status, &status, nullptr) !=
      CL_SUCCESS)
    return std::nullopt;
  return status;
}

// Waits for the launch, and does not take the driver's word that it is over: some come back at
// once, others say that all is well with a launch that failed.
void awaitLaunch(Kernel::Impl& impl, const cl::Event& event) {
  event.wait();
  std::optional<cl_int> status = statusOf(event);
  if (status && *status > CL_COMPLETE) {
    impl.queue.finish();
    for (const Stopwatch watch; (status = statusOf(event)) && *status > CL_COMPLETE;) {
      if (watch.elapsedNs() > kEndPatience_ns)
        throw Error(fmt::format("kernel '{}' does not end: clWaitForEvents and clFinish came back, "
                                "but its event says after {:g} s that it is {}",
                                impl.name, kEndPatience_ns * 1e-9,
                                *status == CL_RUNNING ? "running" : "queued"),
                    kExitNoDevice);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  if (status && *status < 0)
    throw Error(fmt::format("kernel '{}' was launched, but failed with {}", impl.name,
                            openClErrorName(*status)));
}

// Enqueues and waits; `local_size` divides `global_size`, the number of work-items from `first` on.
LaunchTimes launchOnce(Kernel::Impl& impl, std::size_t first, std::size_t global_size,
                       std::size_t local_size) {
  LaunchTimes times;
  const std::pair<std::size_t, bool> kind = {local_size, global_size < kSmallGridItems};
  times.first_enqueue = !impl.launched.contains(kind);
  const TraceScope scope("launch", impl.name);
  const std::string doing = fmt::format("launching kernel '{}'", impl.name);
  std::optional<DriverVisit> first_visit;
  std::optional<ShortVisit> visit;
  if (times.first_enqueue)
    first_visit.emplace(doing, kLaunchPatience);
  else
    visit.emplace(doing);
  const std::int64_t trace_begin_ns = isTracing() ? traceNowNs() : 0;
  const Stopwatch watch;
  cl::Event event;
  impl.queue.enqueueNDRangeKernel(impl.kernel, first > 0 ? cl::NDRange(first) : cl::NullRange,
                                  cl::NDRange(global_size), cl::NDRange(local_size), nullptr,
                                  &event);
  awaitLaunch(impl, event);
  times.wall_ns = watch.elapsedNs();
  times.event_ns = impl.clock->launchNs(eventTimes(event), times.wall_ns);
  if (isTracing()) traceEvent("kernel", impl.name, event, trace_begin_ns, *impl.clock);
  impl.launched.insert(kind);
  if (times.first_enqueue) impl.first_enqueue_ns += times.wall_ns;
  return times;
}

// With smaller groups where the driver refuses `group`, a divisor of `local_size`; it keeps what
// was taken.
LaunchTimes launchInGroups(Kernel::Impl& impl, std::size_t first, std::size_t global_size,
                           std::size_t local_size, std::size_t& group) {
  for (;; group = fittingLocalSize(local_size, group / 2)) {
    try {
      return launchOnce(impl, first, global_size, group);
    } catch (const cl::Error& error) {
      if (group == 1 || !mayBeTooLargeAGroup(error.err())) throw;
    }
  }
}

// In halves where the driver refuses the whole: kernels know of their range by get_global_id alone.
// No part of it is launched twice, since kernels add to what is there.
LaunchTimes launchRange(Kernel::Impl& impl, std::size_t first, std::size_t global_size,
                        std::size_t local_size, std::size_t& group) {
  try {
    return launchInGroups(impl, first, global_size, local_size, group);
  } catch (const cl::Error& error) {
    if (global_size <= local_size || !isTooLargeARange(error.err())) throw;
  }
  const std::size_t half = (global_size / local_size + 1) / 2 * local_size;
  LaunchTimes times = launchRange(impl, first, half, local_size, group);
  const LaunchTimes rest = launchRange(impl, first + half, global_size - half, local_size, group);
  times.event_ns += rest.event_ns;
  times.wall_ns += rest.wall_ns;
  times.first_enqueue = times.first_enqueue || rest.first_enqueue;
  return times;
}

}  // namespace

LaunchTimes Kernel::launch(std::span<const KernelArg> args, std::size_t global_size,
                           std::size_t local_size) {
  if (!impl_) throw Error("an empty kernel was launched; it must come from a program");
  if (local_size == 0)
    throw Error(fmt::format("kernel '{}' needs a local size of at least 1", impl_->name));
  LaunchTimes times;
  if (global_size == 0) return times;
  const std::size_t items = (global_size + local_size - 1) / local_size * local_size;
  std::size_t group = fittingLocalSize(local_size, impl_->max_local_size);
  try {
    setArgs(*impl_, args);
    times = launchRange(*impl_, 0, items, local_size, group);
  } catch (const cl::Error& error) {
    throw openClError(
        fmt::format("kernel '{}' (global size {}, local size {})", impl_->name, items, group),
        error);
  }
  if (group < fittingLocalSize(local_size, impl_->max_local_size)) impl_->max_local_size = group;
  return times;
}

const std::vector<std::string>& Kernel::parameterNames() const {
  if (!impl_) throw Error("an empty kernel was asked for its parameters");
  return impl_->parameter_names;
}

const std::string& Kernel::name() const {
  if (!impl_) throw Error("an empty kernel was asked for its name");
  return impl_->name;
}

double Kernel::firstEnqueueNs() const {
  return impl_ ? impl_->first_enqueue_ns : 0;
}

}  // namespace glintmark
