// Arrays on their way to the device.
#pragma once
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "host/core/large_array.h"
#include "host/ocl/compute.h"

namespace glintmark {

/// A buffer that holds `items`, for kernels to read; of none, room for one, since OpenCL has no
/// empty buffers. Messages call it by its purpose, or by `what`, if given. Throws Error as Buffer
/// does.
template <typename T>
Buffer upload(Device& device, const std::vector<T>& items, BufferPurpose purpose,
              const std::string& what = "") {
  const std::size_t bytes = items.size() * sizeof(T);
  Buffer buffer(device, bytes > 0 ? bytes : sizeof(T), purpose, what);
  if (bytes > 0)
    buffer.write(items.data(), bytes);
  else
    buffer.fillZero();
  return buffer;
}

/// The same of an array that may be gigabytes, which processors use in place.
template <typename T>
Buffer upload(Device& device, LargeArray<T>&& items, BufferPurpose purpose,
              const std::string& what = "") {
  const std::size_t bytes = items.size() * sizeof(T);
  const auto owner = std::make_shared<LargeArray<T>>(std::move(items));
  return Buffer::take(device, std::shared_ptr<void>(owner, owner->data()), bytes, purpose, what);
}

}  // namespace glintmark
