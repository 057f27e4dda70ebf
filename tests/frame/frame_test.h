// A device and options that tests of frames share.
#pragma once
#include <stdlib.h>

#include "host/frame/frame_renderer.h"
#include "host/harness/small_scenes.h"

namespace glintmark {

inline Device& device() {
  static Device* const shared = [] {
    setenv("GLINTMARK_CACHE_DIR", GLINTMARK_BINARY_DIR "/test_cache/programs", 1);
    setenv("POCL_CACHE_DIR", GLINTMARK_BINARY_DIR "/test_cache/pocl", 1);
    return new Device;  // lives as long as the program: drivers dislike late teardown
  }();
  return *shared;
}

inline ShadingOptions smallOptions() {
  ShadingOptions options;
  options.width_px = 160;
  options.height_px = 90;
  options.lanes = 16;
  return options;
}

}  // namespace glintmark
