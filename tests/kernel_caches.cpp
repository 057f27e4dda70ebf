// Programs that the tests compile go to the build folder, where the test programs share them, not
// to the user's caches.
#include <stdlib.h>

namespace {

[[maybe_unused]] const bool kCachesAreChosen = [] {
  setenv("GLINTMARK_CACHE_DIR", GLINTMARK_BINARY_DIR "/test_cache/programs", 0);
  setenv("POCL_CACHE_DIR", GLINTMARK_BINARY_DIR "/test_cache/pocl", 1);
  // A binary to keep would have PoCL, which keeps its own, compile every kernel once more.
  setenv("GLINTMARK_PROGRAM_CACHE", "off", 0);
  return true;
}();

}  // namespace
