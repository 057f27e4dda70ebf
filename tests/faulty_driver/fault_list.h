// What GLINTMARK_FAULTS asks for: "NAME" or "NAME=VALUE", separated by blanks.
//
//   clock=zero        every event time is 0
//   clock=backwards   commands end before they start
//   clock=still       the same times for every command
//   clock=ticks       time in units of 100 ns
//   clock=absent      no event times
//   clock=long        commands take ten times as long
//   clock=fast        commands of any length take 60 ns
//   clock=no_queue    queues that keep times are refused
//   step=NS           event times are multiples of it
//   refuse=FACT       a fact of devices is refused: unified, clock, vector, cache, timer, local
//   zero=FACT         one is 0: memory, units, clock, vector, groups
//   memory=BYTES      the memory of a device, a quarter of it at most in one buffer
//   groups=N          devices and kernels take work-groups of at most N
//   launches=N        they say otherwise, but larger groups are refused when launched
//   global=N          launches of more than N work-items are refused
//   no_arg_info       parameters of kernels have no names
//   build=TEXT        the process dies when a program is built whose options hold TEXT
//   build_s=SECONDS   building any program takes so long
//   resources=KERNEL  launches of it fail with CL_OUT_OF_RESOURCES
//   crash=KERNEL      the process dies at its launch
//   exit=KERNEL       the process ends with exit code 7 at its launch
//   exit=opening      the same when a queue is made
//   abort=opening     it aborts there
//   abort=looking     it aborts when platforms are asked for
//   stall=KERNEL      its launch never ends
//   platforms=none    there is no platform
//   platforms=empty   the first has no devices
//   platforms=broken  its driver fails
//   platforms=ghost   a second platform, which fails, stands before the first
//   twins             every device is listed twice
#pragma once
#include <optional>
#include <string>

namespace faulty {

/// Is "name=value" asked for?
bool asked(const std::string& name, const std::string& value);
/// The value of "name=value", "" for a bare name.
std::optional<std::string> valueOf(const std::string& name);
/// That value as a number; 0 if it is not asked for.
unsigned long long numberOf(const std::string& name);

}  // namespace faulty
