// Drivers that say that all is well and lose or spoil data: no picture, no figure, and the sentence
// names what was lost.
#include <gtest/gtest.h>

#include "tests/faulty_driver/faulty.h"

namespace glintmark {
namespace {

struct Loss {
  const char* faults;
  const char* sentence;
};

void PrintTo(const Loss& loss, std::ostream* out) {
  *out << loss.faults;
}

class Losses : public testing::TestWithParam<Loss> {};

TEST_P(Losses, AreFoundAndNamed) {
  const TempFolder folder;
  const ProcessResult result = runFaulty(renderPlane(folder / "p.exr"), GetParam().faults);
  EXPECT_EQ(result.exit_code, 3) << result.err;
  EXPECT_NE(result.err.find(GetParam().sentence), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "p.exr"));
}

INSTANTIATE_TEST_SUITE_P(
    All, Losses,
    testing::Values(Loss{"skip=shade", "kernel 'shade' left 2304 of 2304 pixels unwritten"},
                    Loss{"half=shade", "pixels unwritten on '"},
                    Loss{"skip=probeTriad", "98304 of 98304 sums"},
                    Loss{"read=nothing", "gave not all of its bytes"},
                    Loss{"read=short", "gave not all of its bytes"},
                    Loss{"read=short from=100000", "gave not all of its"},
                    Loss{"write=nothing", "did not bring all of its"},
                    Loss{"write=short from=100000", "did not bring all of its"},
                    Loss{"data=half from=100", "computes wrongly at "},
                    Loss{"data=odd from=100", "computes wrongly at "},
                    Loss{"data=nan from=100", "computes wrongly at "},
                    Loss{"data=ulps from=100", "computes wrongly at "},
                    Loss{"data=noise from=100", "computes wrongly at "},
                    Loss{"event=queued", "its event says after 10 s that it is queued"}),
    [](const auto& tested) { return testName(tested.param.faults); });

// What has another way is done that way.
class Detours : public testing::TestWithParam<Loss> {};

TEST_P(Detours, ThePictureIsTheSame) {
  const TempFolder folder;
  ASSERT_EQ(runGlintmark(renderPlane(folder / "sane.exr")).exit_code, 0);
  const ProcessResult result = runFaulty(renderPlane(folder / "p.exr"), GetParam().faults);
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(samePixels(folder / "p.exr", folder / "sane.exr"));
}

INSTANTIATE_TEST_SUITE_P(All, Detours,
                         testing::Values(Loss{"fill=nothing", ""}, Loss{"fill=fails", ""},
                                         Loss{"finish=early", ""}, Loss{"no_host_memory", ""},
                                         Loss{"queue=plain", ""}, Loss{"binary=other", ""},
                                         Loss{"binary=refused", ""}, Loss{"resources_at=2", ""}),
                         [](const auto& tested) { return testName(tested.param.faults); });

TEST(Launches, AFailureThatTheEventAloneTellsIsOne) {
  const TempFolder folder;
  const ProcessResult result = runFaulty(renderPlane(folder / "p.exr"), "event=failed");
  EXPECT_EQ(result.exit_code, 2) << result.err;
  EXPECT_NE(result.err.find("was launched, but failed with OpenCL error -9999"), std::string::npos)
      << result.err;
}

TEST(Builds, EveryLogMakesOneLine) {
  for (const auto& [kind, part] :
       {std::pair("empty", "the driver gave no log"), std::pair("none", "the driver gave no log"),
        std::pair("refused", "the driver gave no log"), std::pair("long", "www error: far behind"),
        std::pair("lines", "warning: unused value"), std::pair("latin", "?? error: ??")}) {
    const TempFolder folder;
    std::vector<std::string> environment = faultyEnvironment(std::string("log=") + kind);
    environment.push_back("TMPDIR=" + folder.path().string());
    const ProcessResult result = runGlintmark(renderPlane(folder / "p.exr"), environment);
    EXPECT_EQ(result.exit_code, 2) << kind;
    EXPECT_NE(result.err.find(part), std::string::npos) << result.err;
    EXPECT_LT(result.err.size(), 1000u);
    EXPECT_EQ(countOf(result.err, "\n"), 1u) << result.err;
  }
}

TEST(Builds, AProgramThatWasNeverBuiltDidNotBuild) {
  const TempFolder folder;
  std::vector<std::string> environment = faultyEnvironment("unbuilt");
  environment.push_back("TMPDIR=" + folder.path().string());
  const ProcessResult result = runGlintmark(renderPlane(folder / "p.exr"), environment);
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("does not build on"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace glintmark
