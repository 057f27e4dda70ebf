// A stay in a driver, which may never end, end the program, or leave it other than it was.
#pragma once
#include <string>

#include "host/core/last_words.h"
#include "host/ocl/driver_watch.h"
#include "host/ocl/process_state.h"

namespace glintmark {

/// As long as it lives, this thread is in the driver, which does `what`: "compiling shade.cl".
class DriverVisit {
 public:
  /// Looks for devices, opens them, compiles: all that a driver could change is put back.
  DriverVisit(const std::string& what, Patience patience) : call_(what), watch_(what, patience) {}

 private:
  DriverCall call_;
  DriverWatch watch_;
  ProcessState state_;
};

/// The same for calls that come by the thousand: only the floating-point environment is put back.
class ShortVisit {
 public:
  explicit ShortVisit(const std::string& what) : call_(what), watch_(what, kLaunchPatience) {}

 private:
  DriverCall call_;
  DriverWatch watch_;
  FloatState float_;
};

}  // namespace glintmark
