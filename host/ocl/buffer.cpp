#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "host/core/large_array.h"
#include "host/core/stopwatch.h"
#include "host/core/trace.h"
#include "host/ocl/buffer_check.h"
#include "host/ocl/driver_visit.h"
#include "host/ocl/opencl.h"

namespace glintmark {
namespace {

constexpr std::size_t kMinBytes = 4;  // OpenCL has no buffers of size zero
constexpr std::uintptr_t kPageBytes = 4096;

std::string sizeText(unsigned long long bytes) {
  const double mebibytes = static_cast<double>(bytes) / (1024.0 * 1024.0);
  return mebibytes < 0.1 ? fmt::format("{} bytes", bytes) : fmt::format("{:.1f} MiB", mebibytes);
}

// Memory in large pages, if the system gives them; empty if it has none. A pixel's texels lie all
// over a chain of mixtures, and small pages cost a frame up to a tenth of its time in look-ups of
// addresses.
std::shared_ptr<void> largePages(std::size_t bytes) {
  const LargeMemory found = largeMemory(bytes);
  const std::shared_ptr<void> memory(found.begin, std::free);
  return found.in_large_pages ? memory : nullptr;
}

// In `host` memory, if given; drivers may refuse to use it in place, and get memory of their own.
void makeBuffer(Buffer::Impl& impl, const cl::Context& context, void* host) {
  cl_int status = CL_SUCCESS;
  if (host) {
    const cl_mem_flags flags = CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR;
    if (const cl_mem memory = clCreateBuffer(context(), flags, impl.bytes, host, &status)) {
      impl.buffer = cl::Buffer(memory);
      impl.host = host;
      return;
    }
  }
  impl.buffer = cl::Buffer(context, CL_MEM_READ_WRITE, impl.bytes);
}

std::shared_ptr<Buffer::Impl> allocate(Device& device, std::size_t bytes, void* host,
                                       BufferPurpose purpose, const std::string& given_name) {
  const std::string what = given_name.empty() ? std::string(purposeName(purpose)) : given_name;
  const DeviceInfo& info = device.info();
  if (info.max_alloc_bytes > 0 && bytes > info.max_alloc_bytes)
    throw Error(fmt::format("{} needs {}, but '{}' allows at most {} per buffer", what,
                            sizeText(bytes), info.name, sizeText(info.max_alloc_bytes)));
  auto impl = std::make_shared<Buffer::Impl>();
  impl->queue = device.impl().queue;
  impl->clock = device.impl().clock;
  impl->bytes = bytes;
  impl->purpose = purpose;
  impl->what = what;
  impl->device_name = info.name;
  const ShortVisit visit("allocating " + what);
  try {
    makeBuffer(*impl, device.impl().context, host);
  } catch (const cl::Error& error) {
    throw openClError(
        fmt::format(
            "allocating {} for {} on '{}' (it has {})", sizeText(bytes), what, info.name,
            info.global_mem_bytes > 0 ? sizeText(info.global_mem_bytes) : "memory of unknown size"),
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
  const ShortVisit visit(doing);
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

bool isInPlace(const Buffer::Impl& impl, const void* memory) {
  const auto* begin = static_cast<const char*>(impl.host);
  return begin && memory >= begin && memory < begin + impl.bytes;
}

Held lookFor(const Buffer::Impl& impl, const void* source, std::size_t bytes, std::size_t offset) {
  Held held = Held::kAll;
  const std::string doing = "reading back " + impl.what;
  timed(doing, *impl.clock, [&](cl::Event*) { held = holdsBytes(impl, source, bytes, offset); });
  if (held == Held::kUnread) throwLostData(impl, doing + " gave not all of its bytes");
  return held;
}

// By the command for it, which some drivers do not have, or do nothing for.
bool fillByDevice(Buffer::Impl& impl, std::uint32_t word, std::size_t words) {
  const std::size_t whole = words * sizeof word;
  try {
    timed("clearing " + impl.what, *impl.clock, [&](cl::Event* event) {
      impl.queue.enqueueFillBuffer(impl.buffer, word, 0, whole, nullptr, event);
      impl.queue.finish();
    });
  } catch (const Error&) {
    return false;
  }
  return lookFor(impl, &word, sizeof word, 0) == Held::kAll &&
         lookFor(impl, &word, sizeof word, whole - sizeof word) == Held::kAll;
}

}  // namespace

Buffer::Buffer(Device& device, std::size_t bytes, BufferPurpose purpose, const std::string& what) {
  bytes = std::max(bytes, kMinBytes);
  const std::shared_ptr<void> memory =
      device.info().is_cpu && bytes >= kLeastLargeBytes ? largePages(bytes) : nullptr;
  impl_ = allocate(device, bytes, memory.get(), purpose, what);
  if (impl_->host) impl_->memory = memory;
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
  buffer.impl_ = allocate(device, bytes, in_place ? data : nullptr, purpose, what);
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
  const std::string doing = "writing " + impl.what;
  const double took_ns = timed(doing, *impl.clock, [&](cl::Event* event) {
    impl.queue.enqueueWriteBuffer(impl.buffer, CL_TRUE, offset, bytes, source, nullptr, event);
  });
  if (lookFor(impl, source, bytes, offset) != Held::kAll)
    throwLostData(impl, fmt::format("{} did not bring all of its {} bytes there", doing, bytes));
  return took_ns;
}

double Buffer::read(void* target, std::size_t bytes, std::size_t offset) const {
  Impl& impl = allocated(impl_.get());
  checkRange(impl, bytes, offset, "read");
  if (bytes == 0) return 0;
  const std::string doing = "reading " + impl.what;
  const auto read = [&](std::uint32_t round) {
    const bool in_place = isInPlace(impl, target);
    if (!in_place) plantCanaries(target, bytes, round);
    const double took_ns = timed(doing, *impl.clock, [&](cl::Event* event) {
      impl.queue.enqueueReadBuffer(impl.buffer, CL_TRUE, offset, bytes, target, nullptr, event);
    });
    return std::pair(took_ns, !in_place && canariesLive(target, bytes, round));
  };
  const auto [took_ns, some_live] = read(0);
  if (some_live && read(1).second)  // by no chance twice
    throwLostData(impl, fmt::format("{} gave not all of its {} bytes", doing, bytes));
  return took_ns;
}

void Buffer::fill(std::uint32_t word) {
  Impl& impl = allocated(impl_.get());
  const std::size_t words = impl.bytes / sizeof word;
  if (fillByDevice(impl, word, words) && words * sizeof word == impl.bytes) return;
  const std::vector<std::uint32_t> copy(words + 1, word);
  write(copy.data(), impl.bytes);
}

std::size_t Buffer::bytes() const {
  return impl_ ? impl_->bytes : 0;
}

}  // namespace glintmark
