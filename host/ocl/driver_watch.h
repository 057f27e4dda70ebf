// Says that a driver takes long, and ends the process if it never comes back.
#pragma once
#include <chrono>
#include <list>
#include <string>

namespace glintmark {

/// When it is said first that the driver is not done, then after twice as long each time, and after
/// how long it is taken to hang.
struct Patience {
  std::chrono::seconds note, end;
};

/// Compilers take minutes over one kernel (Mesa 22.3); launches may compile, too, and last.
inline constexpr Patience kCompilerPatience = {std::chrono::seconds(10), std::chrono::hours(1)};
inline constexpr Patience kLaunchPatience = {std::chrono::seconds(30), std::chrono::minutes(10)};

struct WatchedCall {
  std::string what;
  Patience patience = kLaunchPatience;
  std::chrono::seconds next_note{};
  std::chrono::steady_clock::duration took{};
};

/// As long as it lives, `what` ("compiling shade.cl") is awaited: notes on stderr unless these are
/// off; after its patience the process ends with kExitNoDevice, and says why. $GLINTMARK_DRIVER_S
/// puts another end, in seconds, to every patience. Costs no thread of its own: all share one.
class DriverWatch {
 public:
  DriverWatch(std::string what, Patience patience);
  ~DriverWatch();
  DriverWatch(const DriverWatch&) = delete;
  DriverWatch& operator=(const DriverWatch&) = delete;

 private:
  std::list<WatchedCall>::iterator call_;
};

}  // namespace glintmark
