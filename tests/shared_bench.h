// The device that a test program runs kernels on.
#pragma once
#include "host/harness/kernel_bench.h"

namespace glintmark {

/// The default device and its programs, opened at the first call, one for the whole process.
inline KernelBench& testBench() {
  // Lives as long as the program: drivers dislike late teardown.
  static auto* const bench = new KernelBench(Device());
  return *bench;
}

}  // namespace glintmark
