// A device and options that tests of frames share.
#pragma once
#include "host/frame/frame_renderer.h"
#include "host/harness/small_scenes.h"

namespace glintmark {

inline Device& device() {
  // Lives as long as the program: drivers dislike late teardown.
  static auto* const shared = new Device;
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
