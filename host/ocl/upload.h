// Arrays on their way to the device.
#pragma once
#include <string>
#include <vector>

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

}  // namespace glintmark
