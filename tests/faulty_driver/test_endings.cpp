// Drivers that end the process or never come back: one sentence that says where, and an exit code.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/faulty_driver/faulty.h"

namespace glintmark {
namespace {

struct Ending {
  const char* faults;
  const char* sentence;
};

void PrintTo(const Ending& ending, std::ostream* out) {
  *out << ending.faults;
}

class Endings : public testing::TestWithParam<Ending> {};

// exit(0) is the worst of them: all looks well.
TEST_P(Endings, AreSaid) {
  const TempFolder folder;
  const ProcessResult result = runFaulty(renderPlane(folder / "p.exr"), GetParam().faults);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find(GetParam().sentence), std::string::npos) << result.err;
  EXPECT_EQ(countOf(result.err, "glintmark: "), 1u) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "p.exr"));
}

INSTANTIATE_TEST_SUITE_P(
    All, Endings,
    testing::Values(
        Ending{"at=looking:exit0", "ended the program while looking for OpenCL devices: its"},
        Ending{"at=looking:overflow", "while looking for OpenCL devices: its process ended by"},
        Ending{"at=opening:_exit0", "while opening '"},
        Ending{"at=building:exit0", "while compiling probes/probe.cl: its process ended with exit"},
        Ending{"at=building:throw", "while compiling probes/probe.cl: its process ended by signal"},
        Ending{"exit0=shade", "while launching kernel 'shade': its process ended with exit code 0"},
        Ending{"crash=shade", "while launching kernel 'shade': its process ended by signal 11"},
        Ending{"at=launching:overflow", "while launching kernel 'probeTriad': its process ended"},
        Ending{"at=reading:_exit0", "while reading"}),
    [](const auto& tested) { return testName(tested.param.faults); });

TEST(Endings, ACrashAtTheCloseIsSaidOnce) {
  const TempFolder folder;
  const ProcessResult result = runFaulty(renderPlane(folder / "p.exr"), "at=closing:crash");
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find("while releasing"), std::string::npos) << result.err;
}

// What atexit() has is the driver's own affair once all is written.
TEST(Endings, WhatDriversDoAtExitIsNoLonger) {
  for (const char* faults : {"at=opening:crash_at_exit", "at=opening:stall_at_exit"}) {
    const TempFolder folder;
    const ProcessResult result = runFaulty(renderPlane(folder / "p.exr"), faults);
    EXPECT_EQ(result.exit_code, 0) << faults << ": " << result.err;
    EXPECT_EQ(result.err, "");
    EXPECT_TRUE(std::filesystem::exists(folder / "p.exr"));
  }
}

TEST(Endings, ABenchmarkDoesNotEndWellWithoutItsDevice) {
  const TempFolder folder;
  const ProcessResult result = runFaulty({"bench", "zk16", "--quiet", "--scene", "screen_plane",
                                          "--size", "64x36", "--reps", "1", "-o", folder / "r"},
                                         "at=opening:_exit0");
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find("an OpenCL driver ended the program while opening"), std::string::npos)
      << result.err;
}

TEST(Endings, ADriverThatNeverComesBackIsEnded) {
  for (const auto& [faults, what] : {std::pair("build_stalls", "compiling probes/probe.cl"),
                                     std::pair("stall=shade", "launching kernel 'shade'"),
                                     std::pair("at=opening:stall", "opening '"),
                                     std::pair("wait=never", "launching kernel 'probeTriad'")}) {
    const TempFolder folder;
    std::vector<std::string> environment = faultyEnvironment(faults);
    environment.emplace_back("GLINTMARK_DRIVER_S=20");
    const ProcessResult result = runGlintmark(renderPlane(folder / "p.exr"), environment);
    EXPECT_EQ(result.exit_code, 3) << faults << ": " << result.err;
    EXPECT_NE(result.err.find(std::string("glintmark: the OpenCL driver was ") + what),
              std::string::npos)
        << result.err;
    EXPECT_NE(result.err.find("and gave no answer within 20 s"), std::string::npos) << result.err;
  }
}

// Started by a shell that ignores the ends of children: they count all the same.
TEST(Endings, ParentsThatIgnoreChildrenHideNothing) {
  const TempFolder folder;
  struct sigaction before = {}, ignored = {};
  ignored.sa_handler = SIG_IGN;
  sigaction(SIGCHLD, &ignored, &before);
  Process process(renderPlane(folder / "p.exr"), faultyEnvironment("crash=shade"));
  sigaction(SIGCHLD, &before, nullptr);
  EXPECT_EQ(process.wait().exit_code, 3);
}

}  // namespace
}  // namespace glintmark
