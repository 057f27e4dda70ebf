// Work in a process of its own: what comes back, and how its ends are told.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "host/core/child_process.h"

namespace glintmark {
namespace {

void writeText(int out, const std::string& text) {
  ASSERT_EQ(write(out, text.data(), text.size()), static_cast<ssize_t>(text.size()));
}

std::string endOf(const std::function<void(int)>& work, const ChildLimits& limits = {}) {
  ChildProcess child(work, limits);
  char byte = 0;
  child.read(&byte, 1);
  return child.finish();
}

TEST(ChildProcess, HandsBytesBack) {
  ChildProcess child([](int out) { writeText(out, "twelve bytes"); }, {});
  std::string text(20, '.');
  EXPECT_EQ(child.read(text.data(), 7), 7u);
  EXPECT_EQ(child.read(text.data() + 7, 13), 5u);
  EXPECT_EQ(text, "twelve bytes........");
  EXPECT_EQ(child.finish(), "");
}

TEST(ChildProcess, WhatItPrintsIsDropped) {
  testing::internal::CaptureStderr();
  EXPECT_EQ(endOf([](int out) {
              writeText(STDERR_FILENO, "libpng error: of a library");
              writeText(out, ".");
            }),
            "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ChildProcess, SaysHowItEnded) {
  EXPECT_EQ(endOf([](int) { std::raise(SIGSEGV); }), "was ended by signal 11 (Segmentation fault)");
  EXPECT_EQ(endOf([](int) { std::raise(SIGKILL); }), "was ended by signal 9 (Killed)");
  EXPECT_EQ(endOf([](int) { throw std::runtime_error("no"); }), "ended with exit code 1");
  EXPECT_EQ(endOf([](int out) { writeText(out, "x"); }), "");
}

TEST(ChildProcess, WhatNeverEndsIsEnded) {
  const auto spin = [](int) {
    while (getpid() != 0) {
    }
  };
  EXPECT_EQ(endOf(spin, {.cpu_s = 1}), "was not done after 1 s of computing");
  EXPECT_EQ(endOf([](int) { pause(); }, {.wall_s = 0.2}), "was not done after 0.2 s");
}

TEST(ChildProcess, TakesNoMoreMemoryThanItMay) {
  const auto work = [](int out) {
    try {
      const std::vector<char> large(std::size_t{1} << 40);
      writeText(out, std::to_string(large[large.size() / 2]));
    } catch (const std::bad_alloc&) {
      writeText(out, "none");
    }
  };
  ChildProcess child(work, {.memory_bytes = std::size_t{1} << 28});
  char text[5] = "";
  child.read(text, 4);
  EXPECT_EQ(std::string(text), "none");
}

TEST(ChildProcess, SignalsThatThisProcessCatchesEndTheChild) {
  const auto before = std::signal(SIGTERM, [](int) {});
  const std::string end = endOf([](int) { std::raise(SIGTERM); });
  std::signal(SIGTERM, before);
  EXPECT_EQ(end, "was ended by signal 15 (Terminated)");
}

}  // namespace
}  // namespace glintmark
