#include <fmt/format.h>

#include "host/core/stopwatch.h"
#include "host/core/trace.h"
#include "host/ocl/opencl.h"

namespace glintmark {
namespace {

// PoCL compiles a kernel at its first enqueue for each local size, once more for grids of 2^16
// work-items and more (it uses 16-bit indices below).
constexpr std::size_t kSmallGridItems = std::size_t{1} << 16;

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

}  // namespace

LaunchTimes Kernel::launch(std::span<const KernelArg> args, std::size_t global_size,
                           std::size_t local_size) {
  if (!impl_) throw Error("an empty kernel was launched; it must come from a program");
  if (local_size == 0)
    throw Error(fmt::format("kernel '{}' needs a local size of at least 1", impl_->name));
  LaunchTimes times;
  if (global_size == 0) return times;
  const std::size_t groups = (global_size + local_size - 1) / local_size;
  try {
    setArgs(*impl_, args);
    const TraceScope scope("launch", impl_->name);
    const std::int64_t trace_begin_ns = isTracing() ? traceNowNs() : 0;
    const Stopwatch watch;
    cl::Event event;
    impl_->queue.enqueueNDRangeKernel(impl_->kernel, cl::NullRange,
                                      cl::NDRange(groups * local_size), cl::NDRange(local_size),
                                      nullptr, &event);
    event.wait();
    times.wall_ns = watch.elapsedNs();
    const cl_ulong begun_ns = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
    const cl_ulong ended_ns = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
    times.event_ns = static_cast<double>(ended_ns - begun_ns);
    if (isTracing()) traceEvent("kernel", impl_->name, event, trace_begin_ns);
  } catch (const cl::Error& error) {
    throw openClError(fmt::format("kernel '{}' (global size {}, local size {})", impl_->name,
                                  groups * local_size, local_size),
                      error);
  }
  times.first_enqueue =
      impl_->launched.insert({local_size, groups * local_size < kSmallGridItems}).second;
  if (times.first_enqueue) impl_->first_enqueue_ns += times.wall_ns;
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
