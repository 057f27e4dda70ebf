// render and heatmap on small pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "host/core/atomic_file.h"
#include "host/report/picture/cell_statistics.h"
#include "host/report/picture/image_io.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

ProcessResult runQuietly(std::vector<std::string> arguments) {
  arguments.push_back("--quiet");
  ProcessResult result = runGlintmark(arguments);
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.err, "");
  return result;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST(Render, ExrHoldsRadiance) {
  const TempFolder folder;
  runQuietly({"render", "screen_plane", "-o", folder / "a.exr", "--size", "64x36"});
  const Image image = readImage(folder / "a.exr");
  EXPECT_EQ(image.width, 64);
  EXPECT_EQ(image.height, 36);
  EXPECT_EQ(image.channels, 4);
  double sum = 0;
  for (const float value : image.pixels) {
    EXPECT_TRUE(std::isfinite(value) && value >= 0);
    sum += value;
  }
  EXPECT_GT(sum, 64 * 36);  // the plane covers every pixel: alpha alone adds up to that
  EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(Render, NamesTheModuleThatIsMissingBesideTheProgram) {
  const TempFolder folder;
  const std::string program = folder / "glintmark", log = folder / "log.txt",
                    module = folder / "glintmark_codec.so", picture = folder / "a.exr";
  std::filesystem::copy_file(GLINTMARK_BINARY_DIR "/bin/glintmark", program);
  const std::string command =
      program + " render screen_plane --size 32x18 -o " + picture + " >" + log + " 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 2);
  const std::string said = readFile(log);
  EXPECT_NE(said.find("pictures need " + module), std::string::npos) << said;
  EXPECT_FALSE(std::filesystem::exists(picture));
}

TEST(Render, PicturesThatAreNotFiniteAreNotSilent) {
  const TempFolder folder;
  // 1e38 is a float, but not twice what it is multiplied by.
  const ProcessResult result =
      runGlintmark({"render", "screen_plane", "-o", folder / "a.exr", "--size", "32x18", "--set",
                    "light.0.irradiance=3e38", "--set", "material.0.intensity=1e30"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("pixels of the picture are not finite"), std::string::npos)
      << result.err;
  const ProcessResult beyond = runGlintmark(
      {"render", "screen_plane", "-o", folder / "b.exr", "--set", "light.0.irradiance=1e308"});
  EXPECT_EQ(beyond.exit_code, 2);
  EXPECT_NE(beyond.err.find("light.0.irradiance"), std::string::npos) << beyond.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "b.exr"));
}

TEST(Render, ABlackPictureSaysSo) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"render", "screen_plane", "-o", folder / "a.exr", "--size", "32x18", "--set",
                    "light.0.elevation_deg=-50"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("nothing that view steep of screen_plane shows reflects light"),
            std::string::npos)
      << result.err;
  const ProcessResult lit =
      runGlintmark({"render", "screen_plane", "-o", folder / "b.exr", "--size", "32x18"});
  EXPECT_EQ(lit.err.find("picture is black"), std::string::npos) << lit.err;
}

TEST(Render, WhatNoLightReachesIsNotMeasured) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(
      {"bench", "zk16", "--quiet", "--scene", "screen_plane", "--view", "steep", "--size", "32x18",
       "--reps", "1", "-o", folder / "r", "--set", "light.0.elevation_deg=-50"});
  EXPECT_EQ(result.exit_code, 1) << result.err << result.out;
  EXPECT_NE((result.out + result.err).find("nothing that the view shows reflects light to it"),
            std::string::npos)
      << result.out << result.err;
}

TEST(Render, AZoomWithoutLightSaysSo) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"render", "screen_plane", "--zoom", "1", "-o", folder / "a.png", "--size",
                    "16x16", "--set", "light.0.elevation_deg=-50"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("no picture has any light"), std::string::npos) << result.err;
}

// Meshes that reflect nothing before a sky are a picture.
TEST(Render, BlackMeshesBeforeASkyAreNoted) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"render", "hero", "-o", folder / "a.png", "--size", "64x36", "--set",
                    "material.0.intensity=0", "--set", "material.0.albedo=0"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("its meshes are black"), std::string::npos) << result.err;
}

constexpr const char* kAway = "view.0={name=\"steep\", eye=[0, 5, 0], target=[0, 9, 1]}";

TEST(Render, AViewOfNothingSaysSo) {
  const TempFolder folder;
  const ProcessResult result = runGlintmark(
      {"render", "screen_plane", "-o", folder / "a.exr", "--size", "32x18", "--set", kAway});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("view steep of screen_plane covers no pixel, so the picture is empty"),
            std::string::npos)
      << result.err;
  // Behind no mesh there is the sky.
  const ProcessResult sky =
      runGlintmark({"render", "hero", "-o", folder / "sky.png", "--size", "32x18", "--set", kAway});
  EXPECT_EQ(sky.exit_code, 0) << sky.err;
  EXPECT_NE(sky.err.find("the picture is the environment alone"), std::string::npos) << sky.err;
}

// Without a pixel there is no time, no error and no cell: no command has figures of it.
TEST(Render, AViewOfNothingIsNotMeasured) {
  const TempFolder folder;
  const std::vector<std::vector<std::string>> commands = {
      {"profile", "screen_plane"},
      {"heatmap", "screen_plane", "-o", folder / "a.png"},
      {"render", "screen_plane", "--zoom", "1", "-o", folder / "a.png"},
      {"bench", "zk16", "--scene", "screen_plane", "--view", "steep", "-o", folder / "r"}};
  for (std::vector<std::string> command : commands) {
    const std::string name = command[0];
    command.insert(command.end(), {"--size", "32x18", "--quiet", "--set", kAway});
    const ProcessResult result = runGlintmark(command);
    EXPECT_NE(result.exit_code, 0) << name << result.out;
    EXPECT_NE(result.err.find("view steep of screen_plane covers no pixel"), std::string::npos)
        << name << ": " << result.err;
    EXPECT_EQ(result.out, "") << name;
  }
}

TEST(Render, PngAndPlanes) {
  const TempFolder folder;
  const ProcessResult result =
      runQuietly({"render", "screen_plane", "-o", folder / "a.png", "--aov", folder / "planes.exr",
                  "--size", "65x37", "--view", "grazing", "--star"});
  EXPECT_NE(result.out.find("screen_plane/grazing 65x37: raster "), std::string::npos);
  EXPECT_EQ(readImage(folder / "a.png").width, 65);
  const Image planes = readImage(folder / "planes.exr");
  EXPECT_EQ(planes.height, 37);
  for (const char* name :
       {"material", "u.frac", "dudx", "dvdy", "N.Y", "uv.X", "Z", "crypto_material00.R"}) {
    EXPECT_NE(std::ranges::find(planes.channel_names, name), planes.channel_names.end()) << name;
  }
}

TEST(Render, SameCommandSamePicture) {
  const TempFolder folder;
  for (const char* name : {"a.exr", "b.exr"}) {
    runQuietly({"render", "screen_plane", "-o", folder / name, "--size", "64x36"});
  }
  EXPECT_EQ(readImage(folder / "a.exr").pixels, readImage(folder / "b.exr").pixels);
}

TEST(Render, GlintsStarAndSettingsChangeThePicture) {
  const TempFolder folder;
  const std::vector<std::string> base = {"render", "screen_plane", "--size", "64x36"};
  const auto render = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = base;
    arguments.insert(arguments.end(), {"-o", folder / "a.exr"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    runQuietly(arguments);
    return readImage(folder / "a.exr").pixels;
  };
  const std::vector<float> plain = render({});
  EXPECT_NE(plain, render({"--no-glints"}));
  EXPECT_NE(plain, render({"--method", "exact"}));
  EXPECT_NE(plain, render({"--set", "material.glitter.log_density=4"}));
  EXPECT_EQ(plain, render({"--no-star"}));
  EXPECT_EQ(plain, render({"--threads", "1"}));
}

double meanOf(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

// EXR holds what was shaded; the environment is behind it only if asked for. Below the horizon it
// is the ground's even colour, where a mesh is nothing changes.
TEST(Render, TheEnvironmentIsBehindTheMeshes) {
  const TempFolder folder;
  const std::vector<std::string> command = {"render", "glitter", "--size", "32x18", "--no-glints"};
  const auto render = [&](const std::string& file, const std::string& flag) {
    std::vector<std::string> words = command;
    words.insert(words.end(), {"-o", folder / file});
    if (!flag.empty()) words.push_back(flag);
    runQuietly(words);
    return readImage(folder / file);
  };
  const Image bare = render("a.exr", ""), full = render("b.exr", "--background");
  ASSERT_EQ(bare.at(0, 17)[3], 0);
  EXPECT_EQ(bare.at(0, 17)[0], 0);
  const float ground[] = {0.08f, 0.07f, 0.06f};
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(full.at(0, 17)[c], ground[c], 1e-6);
  EXPECT_GT(full.at(0, 0)[2], 0.3f);  // the sky's horizon, 0.4, towards its zenith, 0.3
  EXPECT_EQ(full.at(0, 0)[3], 1);
  int covered = 0;
  for (int y = 0; y < 18; ++y)
    for (int x = 0; x < 32; ++x)
      if (bare.at(x, y)[3] == 1) {
        ++covered;
        EXPECT_TRUE(std::ranges::equal(bare.at(x, y), full.at(x, y))) << x << ' ' << y;
      }
  EXPECT_GT(covered, 50);
  EXPECT_NE(readFile(folder / "a.exr"), readFile(folder / "b.exr"));
  render("a.png", "");
  render("b.png", "--no-background");
  EXPECT_NE(readImage(folder / "a.png").pixels, readImage(folder / "b.png").pixels);
}

TEST(Render, DrawnLightsKeepTheMeanAndDrawLess) {
  const TempFolder folder;
  const auto render = [&](const char* scene, const char* count) {
    runQuietly(
        {"render", scene, "-o", folder / "a.exr", "--size", "96x54", "--drawn-lights", count});
    return readImage(folder / "a.exr").pixels;
  };
  const auto cells = [&](const char* count) {
    runQuietly({"heatmap", "glitter", "-o", folder / "a.png", "--exr", folder / "b.exr", "--size",
                "96x54", "--drawn-lights", count});
    return cellDistribution(readImage(folder / "b.exr")).mean;
  };
  // 15 cones.
  const std::vector<float> all = render("glitter", "0"), some = render("glitter", "2");
  EXPECT_NE(all, some);
  EXPECT_NEAR(meanOf(some) / meanOf(all), 1, 0.03);
  EXPECT_LT(cells("2"), 0.6 * cells("0"));
  // One light is drawn as ever, but for rounding.
  const std::vector<float> one = render("screen_plane", "1"), plain = render("screen_plane", "0");
  for (std::size_t i = 0; i < plain.size(); ++i)
    ASSERT_NEAR(one[i], plain[i], 1e-5f * (1 + plain[i])) << i;
}

// One program for glints under cones and for area lights.
TEST(Render, DrawnLightsBesideAreaLights) {
  const TempFolder folder;
  runQuietly({"render", "mixed", "-o", folder / "a.exr", "--size", "64x36", "--drawn-lights", "4",
              "--aov", folder / "b.exr"});
  const Image planes = readImage(folder / "b.exr");
  EXPECT_NE(std::ranges::find(planes.channel_names, "Z"), planes.channel_names.end());
}

// Options that nothing looks at are said, each in a sentence; quiet runs say nothing.
TEST(Render, SaysWhichOptionsDoNothing) {
  const TempFolder folder;
  const auto notes = [&](const std::string& scene, const std::vector<std::string>& options) {
    std::vector<std::string> arguments = {"render",         scene,    "-o",
                                          folder / "a.exr", "--size", "16x9"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProcessResult result = runGlintmark(arguments);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  };
  const auto expect_note = [&](const std::string& err, const std::string& sentence) {
    EXPECT_NE(err.find("note: " + sentence), std::string::npos) << err;
  };
  expect_note(notes("snow", {"--geometric-aa", "footprint"}),
              "--geometric-aa does nothing to material snow, which has microdetails");
  expect_note(notes("disk", {"--geometric-aa", "footprint"}), "--geometric-aa does nothing to");
  expect_note(notes("snow", {"--ltc-method", "exact"}),
              "--ltc-method does nothing in scene snow, where area lights shine on no normal map");
  expect_note(notes("area_plane", {"--round-lobes"}),
              "--round-lobes does nothing in scene area_plane, where area lights see no stretched");
  EXPECT_EQ(notes("area_brushed", {"--round-lobes"}).find("does nothing"), std::string::npos);
  const std::vector<std::string> stretched_mixture = {
      "--ltc-method", "mixture", "--set", "material.cloth.global_roughness=[0.03, 0.2]"};
  expect_note(notes("area_cloth", stretched_mixture),
              "--ltc-method mixture has no stretched lobes: area lights see material cloth round");
  EXPECT_EQ(notes("area_cloth", {"--ltc-method", "mixture"}).find("note:"), std::string::npos);
  expect_note(notes("snow", {"--no-glints", "--method", "zk16"}),
              "--method does nothing in scene snow, since --no-glints leaves none");
  expect_note(notes("disk", {"--truth", "4", "--normal-method", "lean"}),
              "--normal-method does nothing with --truth, which knows no methods");
  EXPECT_EQ(notes("snow", {"--method", "zk16"}).find("does nothing"), std::string::npos);
  EXPECT_EQ(notes("snow", {"--quiet", "--ltc-method", "exact"}).find("does nothing"),
            std::string::npos);
}

TEST(Render, RefusesOptionsThatWouldDoNothing) {
  const TempFolder folder;
  const auto refused = [&](const std::vector<std::string>& arguments, const char* sentence) {
    const ProcessResult result = runGlintmark(arguments);
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find(sentence), std::string::npos) << result.err;
  };
  const std::string exr = folder / "a.exr";
  refused({"render", "snow", "-o", exr, "--step", "2"}, "--step is from picture to picture");
  refused({"render", "snow", "-o", exr, "--exposure", "2"}, "--exposure is for .png pictures");
  refused({"heatmap", "snow", "--scale", "auto"}, "--scale is of the picture");
  EXPECT_EQ(folder.entryCount(), 0u);
}

// A walk over a tree of cones: few at a rough lobe, and the same picture within some per cent.
TEST(Render, LightCutStaysNearAllCones) {
  const TempFolder folder;
  const auto render = [&](const char* cut) {
    runQuietly({"render", "glitter", "-o", folder / "a.exr", "--size", "48x27", "--no-glints",
                "--no-star", "--set", "environment.cones=96", "--light-cut", cut});
    return readImage(folder / "a.exr").pixels;
  };
  const std::vector<float> all = render("all"), coarse = render("coarse");
  double change = 0, sum = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    change += std::abs(double{coarse[i]} - all[i]);
    sum += all[i];
  }
  EXPECT_GT(change, 0);
  EXPECT_LT(change / sum, 0.1);
  const ProcessResult unknown =
      runGlintmark({"render", "glitter", "-o", folder / "a.exr", "--light-cut", "fin"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("unknown light cut 'fin'; light cuts are all, fine, medium, coarse; "
                             "did you mean fine?"),
            std::string::npos)
      << unknown.err;
}

TEST(Render, DrawnLightsAreUpToEight) {
  const TempFolder folder;
  for (const char* count : {"9", "-1"}) {
    const ProcessResult result =
        runGlintmark({"render", "glitter", "-o", folder / "a.exr", "--drawn-lights", count});
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_NE(result.err.find(std::string("--drawn-lights ") + count + " is not 0 to 8"),
              std::string::npos)
        << result.err;
  }
  EXPECT_EQ(folder.entryCount(), 0u);
}

TEST(Render, PlanesDoNotOverwriteThePicture) {
  const TempFolder folder;
  const ProcessResult result =
      runGlintmark({"render", "screen_plane", "-o", folder / "a.exr", "--aov", folder / "./a.exr"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("is the file of -o too"), std::string::npos) << result.err;
  EXPECT_EQ(folder.entryCount(), 0u);
}

TEST(Heatmap, FilesAgreeWithTheSummary) {
  const TempFolder folder;
  const ProcessResult result =
      runQuietly({"heatmap", "screen_plane", "--view", "grazing", "--size", "64x36", "-o",
                  folder / "a.png", "--exr", folder / "a.exr"});
  const CellDistribution cells = cellDistribution(readImage(folder / "a.exr"));
  EXPECT_EQ(cells.glint_px, 64u * 36u);
  EXPECT_GE(cells.min, 8);
  EXPECT_LE(cells.max, 64);
  std::istringstream summary(linesOf(result.out).at(1));
  std::string word;
  double min = 0, mean = 0, max = 0;
  summary >> word >> min >> word >> mean >> word >> max;
  EXPECT_EQ(min, cells.min);
  EXPECT_NEAR(mean, cells.mean, 1e-3);
  EXPECT_EQ(max, cells.max);
  EXPECT_GE(readImage(folder / "a.png").height, 36 + 20);
}

TEST(Heatmap, SweepTakesMoreCellsTowardsTheHorizon) {
  const TempFolder folder;
  runQuietly({"heatmap", "--sweep-angle", "--size", "64x36", "-o", folder / "a.png", "--csv",
              folder / "a.csv"});
  const std::vector<std::string> lines = linesOf(readFile(folder / "a.csv"));
  ASSERT_EQ(lines.size(), 14u);  // header and 13 angles
  EXPECT_EQ(lines[0], "angle_deg,cells_min,cells_mean,cells_max,guard_hits,ns_per_cell");
  EXPECT_TRUE(lines[1].starts_with("90,8,8,8,0,")) << lines[1];  // [ZK16] Sect. 5: 8 at best
  EXPECT_TRUE(lines[13].starts_with("1,")) << lines[13];
  EXPECT_GT(std::stod(lines[13].substr(2)), 16);
  EXPECT_GE(readImage(folder / "a.png").width, 13 * 64);
}

TEST(Heatmap, ScenesWithoutGlintsAreAnError) {
  const ProcessResult result = runGlintmark(
      {"heatmap", "screen_plane", "--size", "64x36", "--set", "material.glitter.type=smooth"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("no glint material"), std::string::npos) << result.err;
}

}  // namespace
}  // namespace glintmark
