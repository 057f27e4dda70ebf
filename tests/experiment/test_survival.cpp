// Cases that end their process, one inside another.
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>

#include "host/core/error.h"
#include "host/experiment/survival.h"

namespace glintmark {
namespace {

constexpr const char* kTable = "table";
constexpr int kWellDone = 5;

std::string howLost(const std::string& name) {
  const auto found = std::ranges::find(lostCases(), name, &LostCase::name);
  return found == lostCases().end() ? "" : found->how;
}

// Every measurement below runs in a child, which never returns to the test.
int childOf(void (*measure)()) {
  return runSurviving(true, [&](bool) -> int {
    measure();
    _exit(kWellDone);
  });
}

TEST(Survival, ACaseInsideAnotherIsLostAlone) {
  const int code = childOf([] {
    const CaseAtHand view(kTable, "view/first");
    if (isLost(kTable, "view/second")) return;
    const CaseAtHand method(kTable, "view/second");
    signal(SIGSEGV, SIG_DFL);
    raise(SIGSEGV);
  });
  EXPECT_EQ(code, kWellDone);
  EXPECT_EQ(howLost("table view/second").substr(0, 18), "ended by signal 11");
  EXPECT_EQ(howLost("table view/first"), "");
}

TEST(Survival, TheOuterCaseIsAtHandAgainAfterwards) {
  const int code = childOf([] {
    if (isLost(kTable, "whole/first")) return;
    const CaseAtHand view(kTable, "whole/first");
    { const CaseAtHand method(kTable, "whole/second"); }
    _exit(7);
  });
  EXPECT_EQ(code, kWellDone);
  EXPECT_EQ(howLost("table whole/first"), "ended with exit code 7");
  EXPECT_EQ(howLost("table whole/second"), "");
}

// Whoever measures a lost case all the same must not do so for ever.
TEST(Survival, ACaseIsLostOnce) {
  testing::internal::CaptureStderr();
  const int code = childOf([] {
    const CaseAtHand stubborn(kTable, "stubborn");
    _exit(7);
  });
  EXPECT_EQ(code, kExitCheckFailed);
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "glintmark: table stubborn is lost again, its process ended with exit code 7\n");
}

}  // namespace
}  // namespace glintmark
