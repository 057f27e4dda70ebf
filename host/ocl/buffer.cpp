#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#ifdef __linux__
#include <sys/mman.h>
#endif

#include "host/core/large_array.h"
#include "host/core/stopwatch.h"
#include "host/core/trace.h"
#include "host/ocl/opencl.h"

namespace glintmark {
namespace {

constexpr std::size_t kMinBytes = 4;  // OpenCL has no buffers of size zero
constexpr std::uintptr_t kPageBytes = 4096;
constexpr std::size_t kLargePageBytes = std::size_t{2} << 20;  // where a system has them

double mebibytes(unsigned long long bytes) {
  return static_cast<double>(bytes) / (1024.0 * 1024.0);
}

// Memory in large pages, if the system gives them; empty if it has none. A pixel's texels lie all
// over a chain of mixtures, and small pages cost a frame up to a tenth of its time in look-ups of
// addresses.
std::shared_ptr<void> largePages([[maybe_unused]] std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  const std::size_t whole = (bytes + kLargePageBytes - 1) / kLargePageBytes * kLargePageBytes;
  std::shared_ptr<void> memory(std::aligned_alloc(kLargePageBytes, whole), std::free);
  if (memory && ::madvise(memory.get(), whole, MADV_HUGEPAGE) == 0) return memory;
#endif
  return nullptr;
}

std::shared_ptr<Buffer::Impl> allocate(Device& device, std::size_t bytes, cl_mem_flags flags,
                                       void* host, BufferPurpose purpose,
                                       const std::string& given_name) {
  const std::string what = given_name.empty() ? std::string(purposeName(purpose)) : given_name;
  const DeviceInfo& info = device.info();
  if (info.max_alloc_bytes > 0 && bytes > info.max_alloc_bytes)
    throw Error(fmt::format("{} needs {:.1f} MiB, but '{}' allows at most {:.1f} MiB per buffer",
                            what, mebibytes(bytes), info.name, mebibytes(info.max_alloc_bytes)));
  auto impl = std::make_shared<Buffer::Impl>();
  impl->queue = device.impl().queue;
  impl->clock = device.impl().clock;
  impl->bytes = bytes;
  impl->purpose = purpose;
  impl->what = what;
  try {
    impl->buffer = cl::Buffer(device.impl().context, flags, bytes, host);
  } catch (const cl::Error& error) {
    throw openClError(fmt::format("allocating {:.1f} MiB for {} on '{}' (it has {})",
                                  mebibytes(bytes), what, info.name,
                                  info.global_mem_bytes > 0
                                      ? fmt::format("{:.1f} MiB", mebibytes(info.global_mem_bytes))
                                      : "memory of unknown size"),
                      error);
  }
  device.impl().ledger->add(purpose, bytes);
  impl->ledger = device.impl().ledger;
  return impl;
}

void checkRange(const Buffer::Impl& impl, std::size_t bytes, std::size_t offset, const char* verb) {
  if (offset > impl.bytes || bytes > impl.bytes - offset)
    throw Error(fmt::format("cannot {} {} bytes at offset {} of {}, which has {} bytes", verb,
                            bytes, offset, impl.what, impl.bytes));
}

Buffer::Impl& allocated(Buffer::Impl* impl) {
  if (!impl) throw Error("an empty device buffer was used; it must be allocated first");
  return *impl;
}

// Wall time [ns] of `transfer`, which gets the event to fill or, while tracing is off, null, with
// OpenCL errors made into ours.
template <typename Transfer>
double timed(const std::string& doing, const DeviceClock& clock, Transfer&& transfer) {
  const TraceScope scope("transfer", doing);
  const bool traced = isTracing();
  const std::int64_t trace_begin_ns = traced ? traceNowNs() : 0;
  const Stopwatch watch;
  try {
    cl::Event event;
    transfer(traced ? &event : nullptr);
    if (traced) traceEvent("transfer", doing, event, trace_begin_ns, clock);
  } catch (const cl::Error& error) {
    throw openClError(doing, error);
  }
  return watch.elapsedNs();
}

}  // namespace

Buffer::Buffer(Device& device, std::size_t bytes, BufferPurpose purpose, const std::string& what) {
  bytes = std::max(bytes, kMinBytes);
  const std::shared_ptr<void> memory =
      device.info().is_cpu && bytes >= kLeastLargeBytes ? largePages(bytes) : nullptr;
  impl_ =
      allocate(device, bytes, CL_MEM_READ_WRITE | (memory ? CL_MEM_USE_HOST_PTR : cl_mem_flags{0}),
               memory.get(), purpose, what);
  impl_->memory = memory;
}

Buffer Buffer::wrapHost(Device& device, void* data, std::size_t bytes, BufferPurpose purpose,
                        const std::string& given_name) {
  const std::string what = given_name.empty() ? std::string(purposeName(purpose)) : given_name;
  if (bytes == 0) throw Error(fmt::format("{} has no bytes to wrap; at least one is needed", what));
  if (!data || reinterpret_cast<std::uintptr_t>(data) % kPageBytes != 0)
    throw Error(fmt::format("{} cannot be wrapped because it is not aligned to {} bytes", what,
                            kPageBytes));
  const bool in_place = device.info().is_cpu || device.info().host_unified_memory;
  Buffer buffer;
  buffer.impl_ = allocate(device, bytes,
                          CL_MEM_READ_WRITE | (in_place ? CL_MEM_USE_HOST_PTR : cl_mem_flags{0}),
                          in_place ? data : nullptr, purpose, what);
  return buffer;
}

Buffer Buffer::take(Device& device, std::shared_ptr<void> memory, std::size_t bytes,
                    BufferPurpose purpose, const std::string& what) {
  const bool is_paged = reinterpret_cast<std::uintptr_t>(memory.get()) % kPageBytes == 0;
  if (device.info().is_cpu && is_paged && bytes >= kLeastLargeBytes) {
    Buffer buffer = wrapHost(device, memory.get(), bytes, purpose, what);
    buffer.impl_->memory = std::move(memory);
    return buffer;
  }
  Buffer buffer(device, bytes, purpose, what);
  buffer.write(memory.get(), bytes);
  return buffer;
}

// A write from, or a read into, the very memory that a CL_MEM_USE_HOST_PTR buffer wraps is defined
// by OpenCL 1.2 Sect. 5.2.2 and costs a device that uses the memory in place nothing, so wrapped
// buffers take the same path as all others.
double Buffer::write(const void* source, std::size_t bytes, std::size_t offset) {
  Impl& impl = allocated(impl_.get());
  checkRange(impl, bytes, offset, "write");
  if (bytes == 0) return 0;
  return timed("writing " + impl.what, *impl.clock, [&](cl::Event* event) {
    impl.queue.enqueueWriteBuffer(impl.buffer, CL_TRUE, offset, bytes, source, nullptr, event);
  });
}

double Buffer::read(void* target, std::size_t bytes, std::size_t offset) const {
  Impl& impl = allocated(impl_.get());
  checkRange(impl, bytes, offset, "read");
  if (bytes == 0) return 0;
  return timed("reading " + impl.what, *impl.clock, [&](cl::Event* event) {
    impl.queue.enqueueReadBuffer(impl.buffer, CL_TRUE, offset, bytes, target, nullptr, event);
  });
}

void Buffer::fillZero() {
  Impl& impl = allocated(impl_.get());
  timed("clearing " + impl.what, *impl.clock, [&](cl::Event* event) {
    impl.queue.enqueueFillBuffer(impl.buffer, cl_uchar{0}, 0, impl.bytes, nullptr, event);
    impl.queue.finish();
  });
}

std::size_t Buffer::bytes() const {
  return impl_ ? impl_->bytes : 0;
}

}  // namespace glintmark
