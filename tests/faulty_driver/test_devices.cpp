// Limits, refused facts and names that look alike: the right picture, or a sentence that says why
// not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/faulty_driver/faulty.h"

namespace glintmark {
namespace {

class Limits : public testing::TestWithParam<const char*> {};

// Bands and groups differ, the arithmetic does not.
TEST_P(Limits, ThePictureIsTheSame) {
  const TempFolder folder;
  const ProcessResult sane = runGlintmark(renderGlitter(folder / "sane.exr"));
  ASSERT_EQ(sane.exit_code, 0) << sane.err;
  const ProcessResult result = runFaulty(renderGlitter(folder / "faulty.exr"), GetParam());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(samePixels(folder / "faulty.exr", folder / "sane.exr"));
}

INSTANTIATE_TEST_SUITE_P(All, Limits,
                         testing::Values("groups=1", "groups=12", "groups=48", "launches=16",
                                         "launches=1", "global=300", "zero=groups", "zero=memory",
                                         "memory=8000000", "no_arg_info",
                                         "refuse=unified refuse=clock refuse=cache",
                                         "zero=units zero=clock", "platforms=ghost"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name)
                             if (c == '=' || c == ' ') c = '_';
                           return name;
                         });

class PoclGroups : public testing::TestWithParam<const char*> {};

TEST_P(PoclGroups, ChecksPass) {
  const ProcessResult result =
      runGlintmark({"verify", "--quiet", "--only", "^(seeds|device|binomial)/"},
                   {std::string("POCL_MAX_WORK_GROUP_SIZE=") + GetParam()});
  EXPECT_EQ(result.exit_code, 0) << result.err << result.out;
}

INSTANTIATE_TEST_SUITE_P(All, PoclGroups, testing::Values("1", "12", "32", "48"));

TEST(Info, EndsOnEveryOddDevice) {
  for (const char* faults : {"groups=1", "groups=12", "zero=memory", "memory=8000000", "launches=8",
                             "global=70000", "zero=units zero=clock zero=vector zero=groups",
                             "refuse=unified refuse=timer refuse=local"}) {
    const ProcessResult result = runFaulty({"info", "--timer", "wall"}, faults);
    EXPECT_EQ(result.exit_code, 0) << faults << ": " << result.err;
    EXPECT_NE(result.out.find("FMA peak"), std::string::npos) << result.out;
  }
}

TEST(Info, NamesWhatADriverRefusesAndWhatIsUnknown) {
  const ProcessResult refused = runFaulty({"info"}, "refuse=unified zero=memory");
  EXPECT_NE(refused.out.find("refused     HOST_UNIFIED_MEMORY"), std::string::npos) << refused.out;
  EXPECT_NE(refused.out.find("memory      unknown"), std::string::npos) << refused.out;
}

TEST(Info, ListsBrokenPlatformsBesideGoodOnes) {
  const TempFolder folder;
  const ProcessResult result =
      runFaulty({"info", "--json", folder / "info.json"}, "platforms=ghost");
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("its driver fails with CL_OUT_OF_HOST_MEMORY"), std::string::npos)
      << result.out;
  const auto json = nlohmann::json::parse(readFile(folder / "info.json"));
  EXPECT_EQ(json["schema"], "glintmark.info/1");
  ASSERT_GE(json["platforms"].size(), 2u);
  EXPECT_NE(json["platforms"][0]["problem"], "");
  EXPECT_EQ(json["platforms"][1]["problem"], "");
  EXPECT_EQ(json["platforms"][1]["devices"][0]["index"], 0);
  EXPECT_EQ(json["chosen"]["index"], 0);
}

// No platform, a platform without devices and a driver that fails are three things.
TEST(Info, SaysWhyThereIsNoDevice) {
  const auto errorOf = [](const char* faults) {
    const ProcessResult result = runFaulty({"info"}, faults);
    EXPECT_EQ(result.exit_code, 3) << faults;
    return result.err;
  };
  EXPECT_NE(errorOf("platforms=none").find("no OpenCL driver is installed"), std::string::npos);
  EXPECT_NE(errorOf("platforms=empty").find("it has no devices"), std::string::npos);
  EXPECT_NE(errorOf("platforms=broken").find("its driver fails with CL_OUT_OF_HOST_MEMORY"),
            std::string::npos);
}

TEST(Info, SaysThatADriverAborted) {
  for (const char* faults : {"abort=looking", "abort=opening"}) {
    const ProcessResult result = runFaulty({"info"}, faults);
    EXPECT_EQ(result.exit_code, 3) << faults;
    EXPECT_NE(result.err.find("an OpenCL driver ended the program"), std::string::npos)
        << result.err;
  }
}

TEST(Info, NamesADriverThatCannotBeLoaded) {
  const TempFolder folder;
  writeFile(folder / "missing.icd", "/no/such/libdriver.so\n");
  const ProcessResult result = runGlintmark({"info", "--json", folder / "info.json"},
                                            {"OCL_ICD_VENDORS=" + folder.path().string()});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_NE(result.out.find("missing.icd: /no/such/libdriver.so: cannot open"), std::string::npos)
      << result.out;
  EXPECT_NE(result.err.find("missing.icd"), std::string::npos) << result.err;
  const auto json = nlohmann::json::parse(readFile(folder / "info.json"));
  EXPECT_EQ(json["broken_drivers"].size(), 1u);
  EXPECT_TRUE(json["chosen"].is_null());
}

TEST(Selection, NamesThatSeveralDevicesHaveAreRefused) {
  const ProcessResult by_name = runFaulty({"info", "--device", "p"}, "twins");
  EXPECT_EQ(by_name.exit_code, 3);
  EXPECT_NE(by_name.err.find("is the name of several OpenCL devices, 0: "), std::string::npos)
      << by_name.err;
  EXPECT_NE(by_name.err.find("choose by index"), std::string::npos) << by_name.err;
  const ProcessResult by_index = runFaulty({"info", "--device", "1"}, "twins");
  EXPECT_EQ(by_index.exit_code, 0) << by_index.err;
  EXPECT_NE(by_index.out.find("chosen: device 1 "), std::string::npos) << by_index.out;
}

TEST(Builds, ACompilerThatTakesLongIsSaid) {
  const TempFolder folder;
  const ProcessResult result = runFaulty(
      {"render", "screen_plane", "--size", "32x18", "-o", folder / "o.exr"}, "build_s=11");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(countOf(result.err,
                    "note: the driver has been compiling shade.cl for 10 s and is not done\n"),
            1u)
      << result.err;
}

TEST(Launches, AnErrorNamesTheKernel) {
  const TempFolder folder;
  const ProcessResult result = runFaulty(renderGlitter(folder / "o.exr"), "resources=shade");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("kernel 'shade'"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("CL_OUT_OF_RESOURCES"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "o.exr"));
}

}  // namespace
}  // namespace glintmark
