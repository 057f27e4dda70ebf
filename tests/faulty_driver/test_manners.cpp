// Drivers that leave the process other than they found it, and say odd things of their devices.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/faulty_driver/faulty.h"

namespace glintmark {
namespace {

// Rasterized in single precision on the host, whose rounding a driver may change.
class Manners : public testing::TestWithParam<const char*> {};

TEST_P(Manners, ThePictureIsTheSame) {
  const TempFolder folder;
  ASSERT_EQ(runGlintmark(renderGlitter(folder / "sane.exr")).exit_code, 0);
  const ProcessResult result = runFaulty(renderGlitter(folder / "faulty.exr"), GetParam());
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  EXPECT_TRUE(samePixels(folder / "faulty.exr", folder / "sane.exr"));
}

INSTANTIATE_TEST_SUITE_P(All, Manners,
                         testing::Values("at=looking:round_down", "at=opening:round_down",
                                         "at=opening:flush_to_zero", "at=launching:traps",
                                         "at=opening:locale", "at=opening:umask",
                                         "at=opening:closes_output", "at=opening:closes_all",
                                         "at=building:chdir", "at=opening:thread", "facts=sizeless",
                                         "facts=narrow", "kernel_groups=3", "fact=items:1",
                                         "fact=buffer:0xffffffffffffffff", "fact=units:4000000000",
                                         "fact=timer:18446744073709551615"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

TEST(Output, HoldsNoWordOfTheDriver) {
  for (const char* when : {"looking", "opening", "building", "launching"}) {
    const TempFolder folder;
    const ProcessResult result =
        runFaulty(renderGlitter(folder / "p.exr"), std::string("at=") + when + ":print");
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(result.out.find("driver: a word"), std::string::npos) << when << result.out;
    EXPECT_NE(result.err.find("driver: a word"), std::string::npos) << when << result.err;
  }
}

// Relative names are those of where the program was started.
TEST(Output, LiesWhereItWasAsked) {
  const TempFolder folder;
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const ProcessResult result =
      runFaulty(renderGlitter("p.exr"), "at=opening:chdir at=building:chdir");
  std::filesystem::current_path(here);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder / "p.exr"));
}

TEST(Names, OfAnyBytesAreOneLineOfText) {
  for (const auto& [kind, shown] :
       {std::pair("blank", "(no name)"), std::pair("open", "no end"), std::pair("cut", "first"),
        std::pair("latin", "caf? ??"), std::pair("lines", "one two ?[31mred?[0m"),
        std::pair("markup", "<a href=\"x\">&'\\ {} %s")}) {
    const TempFolder folder;
    const ProcessResult result =
        runFaulty({"verify", "--quiet", "--only", "^device/structs$", "--json", folder / "v.json"},
                  std::string("name=") + kind);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.out.find(std::string(shown) + " ("), std::string::npos) << result.out;
    const auto json = nlohmann::json::parse(readFile(folder / "v.json"));
    EXPECT_EQ(json["run"]["device"], shown);
  }
}

TEST(Names, OfAnyLengthAreCut) {
  const ProcessResult result =
      runFaulty({"verify", "--quiet", "--only", "^device/structs$"}, "name=long");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("xxx... ("), std::string::npos) << result.out;
  EXPECT_LT(result.out.size(), 2000u);
}

}  // namespace
}  // namespace glintmark
