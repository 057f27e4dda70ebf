// libFuzzer's entry; the build names the target, FUZZ_ENTRY.
#include "fuzz/entries.h"

extern "C" int LLVMFuzzerTestOneInput(const char* data, std::size_t size) {
  glintmark::fuzz::FUZZ_ENTRY({data, size});
  return 0;
}
