// What a frame, and the programs that shade it, took.
#pragma once
#include <vector>

#include "host/ocl/kernel_config.h"

namespace glintmark {

/// Times of one frame [ns]. Shading is the sum over the launches of all materials.
struct FrameTimes {
  double raster_ns = 0;
  double upload_ns = 0;
  double shading_event_ns = 0;            // by LaunchTimes::event_ns
  double shading_wall_ns = 0;             // enqueue to finish on the host's clock
  std::vector<double> launch_event_ns{};  // by launch: a band's pixel lists, then the next band's
  double readback_ns = 0;
};

/// Times of one program [ns].
struct ProgramBuild {
  KernelConfig config;
  double build_ns = 0;          // clBuildProgram
  double first_enqueue_ns = 0;  // first launches, in which PoCL compiles
  bool from_disk_cache = false;
};

}  // namespace glintmark
