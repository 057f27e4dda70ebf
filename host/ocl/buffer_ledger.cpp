#include <algorithm>

#include "host/ocl/opencl.h"

namespace glintmark {

void BufferLedger::add(BufferPurpose purpose, std::size_t bytes) {
  const std::scoped_lock lock(mutex_);
  for (BufferBytes* count : {&use_.by_purpose[purpose], &use_.total}) {
    count->held += bytes;
    count->peak = std::max(count->peak, count->held);
  }
}

void BufferLedger::remove(BufferPurpose purpose, std::size_t bytes) {
  const std::scoped_lock lock(mutex_);
  use_.by_purpose[purpose].held -= bytes;
  use_.total.held -= bytes;
}

BufferUse BufferLedger::use() const {
  const std::scoped_lock lock(mutex_);
  return use_;
}

void BufferLedger::resetPeaks() {
  const std::scoped_lock lock(mutex_);
  std::erase_if(use_.by_purpose, [](const auto& entry) { return entry.second.held == 0; });
  for (auto& [purpose, count] : use_.by_purpose) count.peak = count.held;
  use_.total.peak = use_.total.held;
}

BufferUse Device::bufferUse() const {
  return impl_->ledger->use();
}

void Device::resetBufferPeaks() {
  impl_->ledger->resetPeaks();
}

}  // namespace glintmark
