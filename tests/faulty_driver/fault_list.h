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
//   clock=garbage     every seventh command ends in the far future
//   queue=plain       queues with any property are refused, with another code; =refused: all
//   step=NS           event times are multiples of it
//   refuse=FACT       a fact of devices is refused: unified, clock, vector, cache, timer, local
//   zero=FACT         one is 0: memory, units, clock, vector, groups
//   fact=FACT:VALUE   one has this value; faulty_facts.cpp has their names
//   facts=narrow      half of the bytes of long facts are not written
//   facts=wide        facts of up to eight bytes are refused; =sizeless: none says its size
//   name=KIND         the device is called oddly: blank, open (no NUL), cut (a NUL in the middle),
//                     long, latin (no UTF-8), lines, markup
//   c_version=TEXT    of its OpenCL C
//   memory=BYTES      the memory of a device, a quarter of it at most in one buffer
//   groups=N          devices and kernels take work-groups of at most N
//   kernel_groups=N   kernels say so, devices do not
//   launches=N        they say otherwise, but larger groups are refused when launched
//   global=N          launches of more than N work-items are refused
//   no_arg_info       parameters of kernels have no names
//   build=TEXT        the process dies when a program is built whose options hold TEXT
//   build_s=SECONDS   building any program takes so long; build_stalls: for ever
//   log=KIND          no program can be built, and the log is empty, none, long (10 MB in a line),
//                     lines (100000), latin or refused
//   unbuilt           programs are said to be built, and are not
//   binary=KIND       binaries are refused, empty, or another program is made of them (other)
//   unmade=KERNEL     it cannot be made
//   args=KERNEL       its third argument is refused
//   args_stay=KERNEL  after twenty of its arguments none is set any more
//   resources=KERNEL  launches of it fail with CL_OUT_OF_RESOURCES
//   resources_at=N    the N-th launch of all does
//   lazy=KERNEL       the memory of its buffers is missing when it is launched
//   lost=N            after N launches the device is not available
//   skip=KERNEL       its launches succeed and do nothing
//   half=KERNEL       half of its work-items run
//   wait=KIND         waiting for events fails, comes back early, or never
//   event=KIND        all events say that they failed, or are queued
//   finish=KIND       clFinish fails, or comes back early
//   crash=KERNEL      the process dies at its launch
//   exit=KERNEL       the process ends with exit code 7 at its launch; exit0: with 0
//   exit=opening      the same when a queue is made
//   abort=opening     it aborts there
//   abort=looking     it aborts when platforms are asked for
//   stall=KERNEL      its launch never ends
//   read=KIND         reading buffers fails, copies nothing, or half (short)
//   write=KIND        the same of writing; lazy: there is no memory for it
//   fill=KIND         the same of filling: fails, nothing
//   data=KIND         what is read is wrong: half, odd (elements are 0), nan, ulps, percent, black,
//                     noise
//   from=BYTES        the last four hold for transfers of so many bytes and more
//   allocates=BYTES   larger buffers are refused when they are made
//   no_host_memory    buffers in memory of the host are refused
//   at=WHEN:DEED      what else drivers do: WHEN is looking, opening, building, launching, reading
//                     or closing, DEED a row of faulty_manners.cpp
//   platforms=none    there is no platform; =absent: said by an error of its own
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
/// VALUE of "name=PART:VALUE".
std::optional<std::string> valueOfPart(const std::string& name, const std::string& part);
/// The value of "name=value" as a number; 0 if it is not asked for.
unsigned long long numberOf(const std::string& name);

}  // namespace faulty
