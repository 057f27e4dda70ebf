// profile, and what render shows beside a frame: ground truths and normal methods.
#include <gtest/gtest.h>

#include <filesystem>

#include "host/core/atomic_file.h"
#include "host/report/metrics.h"
#include "host/report/picture/image_io.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

TEST(Profile, WritesWhatRuns) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"profile", "screen_plane", "--size", "64x36", "--seconds", "0.01", "-o",
                    folder / "code", "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("screen_plane/steep 64x36: "), std::string::npos) << result.out;
  const std::string options = readFile(folder / "code/shade_0.options");
  EXPECT_TRUE(options.starts_with("-I kernels ")) << options;
  EXPECT_NE(options.find("-D GLINT_METHOD="), std::string::npos) << options;
  EXPECT_EQ(readFile(folder / "code/kernels/shade.cl"),
            readFile(GLINTMARK_SOURCE_DIR "/kernels/shade.cl"));
  const bool has_object = std::filesystem::exists(folder / "code/shade_0.so");
  const std::string code = readFile(folder / (has_object ? "code/shade_0.so" : "code/shade_0.bin"));
  if (has_object) {
    EXPECT_TRUE(
        code.starts_with("\x7F"
                         "ELF"));
  }
  EXPECT_GT(code.size(), 1000u);
}

TEST(Profile, BadInput) {
  for (const char* seconds : {"0", "-1", "1e9"}) {
    const ProcessResult result = runGlintmark({"profile", "screen_plane", "--seconds", seconds});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find("--seconds"), std::string::npos) << result.err;
  }
  EXPECT_EQ(runGlintmark({"profile", "screen_plane", "--normal-method", "best"}).exit_code, 2);
  EXPECT_EQ(runGlintmark({"profile", "screen_plane", "--ltc-method", "best"}).exit_code, 2);
}

TEST(RenderTruth, IsCloserToItselfThanUnfilteredNormals) {
  const TempFolder folder;
  const auto render = [&](const std::string& name, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render",  "disk", "--size",     "64x36",
                                          "--quiet", "-o",   folder / name};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = runGlintmark(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return readImage(folder / name);
  };
  const Image truth = render("truth.exr", {"--truth", "64"});
  const double other_samples = relMse(render("half.exr", {"--truth", "32"}), truth);
  const double fixed = relMse(render("fixed.exr", {"--normal-method", "fixed"}), truth);
  EXPECT_GT(other_samples, 0);
  EXPECT_LT(other_samples, 0.5 * fixed);
}

TEST(RenderFacts, SayHowAPictureWasMadeAndAreTheSameTwice) {
  const TempFolder folder;
  for (const char* name : {"a.exr", "a.png"}) {
    std::string first;
    for (int i = 0; i < (std::string(name) == "a.exr" ? 2 : 1); ++i) {
      const ProcessResult result = runGlintmark(
          {"render", "screen_plane", "--size", "64x36", "--quiet", "-o", folder / name},
          {"SOURCE_DATE_EPOCH=86400"});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      const std::string bytes = readFile(folder / name);
      for (const char* part : {"glintmark:version", "glintmark:device", "glintmark:inputs",
                               "glintmark:command", "render screen_plane --size 64x36"})
        EXPECT_NE(bytes.find(part), std::string::npos) << name << " has no " << part;
      if (i > 0) {
        EXPECT_TRUE(bytes == first) << name;
      }
      first = bytes;
    }
  }
}

TEST(RenderPath, NumbersItsPicturesAndSaysWhatChanges) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"render", "screen_plane", "--size", "64x36", "--quiet", "-o", folder / "a.png",
                    "--frames", "2", "--path", "orbit", "--step", "5"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("2 frames along orbit, frame-to-frame error 0."), std::string::npos)
      << result.out;
  EXPECT_NE(readFile(folder / "a_0001.png"), readFile(folder / "a_0000.png"));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.png"));
}

TEST(RenderPath, BadInput) {
  const auto refused = [](const std::vector<std::string>& more, const std::string& sentence) {
    std::vector<std::string> arguments = {"render", "screen_plane", "-o",
                                          "a.png",  "--size",       "64x36"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProcessResult result = runGlintmark(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
  };
  refused({"--frames", "0", "--path", "orbit"}, "--frames 0 is not from 1");
  refused({"--path", "orbit"}, "--frames and --path go together");
  refused({"--frames", "2", "--path", "crane"}, "paths are orbit, dolly and pan");
  refused({"--frames", "3", "--path", "dolly", "--step", "50"}, "reaches the target");
}

TEST(RenderFacts, TheDateOfARunMayBeGiven) {
  const TempFolder folder;
  const std::string file = folder / "found.json";
  const std::vector<std::string> words = {"verify", "--only", "^maths/exp2$",
                                          "--json", file,     "--quiet"};
  ASSERT_EQ(runGlintmark(words, {"SOURCE_DATE_EPOCH=86400"}).exit_code, 0);
  EXPECT_NE(readFile(file).find("1970-01-02T00:00:00Z"), std::string::npos);
  const ProcessResult wrong = runGlintmark(words, {"SOURCE_DATE_EPOCH=yesterday"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("SOURCE_DATE_EPOCH is 'yesterday'"), std::string::npos) << wrong.err;
}

TEST(RenderTruth, BadInput) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"--truth", "-3"},
                                                {"--truth", "4", "--aov", "planes.exr"},
                                                {"--zoom", "3", "--truth", "4"},
                                                {"--truth", "2000000"}}) {
    std::vector<std::string> arguments = {"render", "disk", "-o", "picture.exr"};
    arguments.insert(arguments.end(), words.begin(), words.end());
    const ProcessResult result = runGlintmark(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find(words[0]), std::string::npos) << result.err;
  }
}

}  // namespace
}  // namespace glintmark
