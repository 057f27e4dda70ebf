// Signals while drivers are opened, and after.
#include <gtest/gtest.h>

#include <csignal>

#include "host/core/error.h"
#include "host/ocl/driver_death.h"

namespace glintmark {
namespace {

using Handler = void (*)(int);

void driversHandler(int) {}

Handler handlerOf(int number) {
  struct sigaction now = {};
  sigaction(number, nullptr, &now);
  return now.sa_handler;
}

TEST(DriverDeath, HandlersAreAsBefore) {
  const Handler before = handlerOf(SIGILL);
  {
    const DriverDeath death;
    EXPECT_NE(handlerOf(SIGILL), before);
  }
  EXPECT_EQ(handlerOf(SIGILL), before);
}

// PoCL passes over divisions by zero in kernels by one of its own.
TEST(DriverDeath, HandlersOfADriverStay) {
  const Handler before = handlerOf(SIGFPE);
  {
    const DriverDeath death;
    std::signal(SIGFPE, driversHandler);
  }
  EXPECT_EQ(handlerOf(SIGFPE), driversHandler);
  std::signal(SIGFPE, before);
}

void crashWhileOpening() {
  const DriverDeath death;
  std::raise(SIGSEGV);
}

// A driver took the handler for what stood there before its own, and goes back to it.
void crashAfterwards() {
  Handler kept = nullptr;
  {
    const DriverDeath death;
    kept = handlerOf(SIGSEGV);
  }
  std::signal(SIGSEGV, kept);
  std::raise(SIGSEGV);
}

TEST(DriverDeathTest, SpeaksOfOpeningOnlyThen) {
  EXPECT_EXIT(crashWhileOpening(), testing::ExitedWithCode(kExitNoDevice),
              "an OpenCL driver ended the program while its devices were opened");
  EXPECT_EXIT(crashAfterwards(), testing::KilledBySignal(SIGSEGV), "^$");
}

}  // namespace
}  // namespace glintmark
