// fit gmm: what it reads, prints, writes and keeps, and what bad maps and options get.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>

#include "host/core/atomic_file.h"
#include "host/report/picture/image_io.h"
#include "tests/cli/process.h"

namespace glintmark {
namespace {

class FitGmm : public testing::Test {
 protected:
  ProcessResult fit(const std::vector<std::string>& options) const {
    std::vector<std::string> arguments = {"fit", "gmm", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return runGlintmark(arguments, {"GLINTMARK_CACHE_DIR=" + (folder_ / "cache").string()});
  }

  std::string expectDone(const std::vector<std::string>& options) const {
    const ProcessResult result = fit(options);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.out;
  }

  // Fails with one sentence that has every one of `parts`.
  void expectRefusal(const std::vector<std::string>& options,
                     const std::vector<std::string>& parts) const {
    const ProcessResult result = fit(options);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    for (const std::string& part : parts)
      EXPECT_NE(result.err.find(part), std::string::npos)
          << "no '" << part << "' in " << result.err;
  }

  std::string path(const char* name) const { return folder_ / name; }

  void writeMap(const char* name, const Image& image) const {
    std::filesystem::path(name).extension() == ".exr" ? writeExr(image, path(name))
                                                      : writePng(image, path(name));
  }

  const TempFolder folder_;
};

// Image of unit normals, stored as (n + 1) / 2, that lean along x by a wave.
Image wave(int width, int height, float amplitude = 0.5f) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float lean = amplitude * std::sin(static_cast<float>(x + y));
      const float normal[] = {lean, 0, std::sqrt(1 - lean * lean)};
      std::ranges::transform(normal, image.at(x, y).begin(),
                             [](float n) { return 0.5f * n + 0.5f; });
    }
  return image;
}

// Grey heights of 16 bits; PGM is big-endian.
void writePgm16(const std::string& file, int width, int height) {
  std::ofstream out(file, std::ios::binary);
  out << "P5\n" << width << ' ' << height << "\n65535\n";
  for (int i = 0; i < width * height; ++i) {
    const auto value = static_cast<unsigned>(32768 + 20000 * std::sin(0.7 * i));
    out.put(static_cast<char>(value >> 8)).put(static_cast<char>(value & 255));
  }
}

void expectPart(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "no '" << part << "' in " << text;
}

TEST_F(FitGmm, PrintsEveryLevelAndFitsTheTerminal) {
  const std::string out = expectDone({"disk", "--size", "32"});
  for (const char* part : {"disk 32x32: 4 lobes", "fitted in", "EM steps", "converged",
                           "log-likelihood", "misalignment", "16x16", "1x1"})
    expectPart(out, part);
  std::size_t begin = 0;
  for (std::size_t end; (end = out.find('\n', begin)) != std::string::npos; begin = end + 1)
    EXPECT_LE(end - begin, 100u) << out.substr(begin, end - begin);
}

TEST_F(FitGmm, ReadsEightAndSixteenBitsAndFloatsOfAnyShape) {
  writeMap("eight.png", wave(24, 10));
  expectPart(expectDone({path("eight.png")}), "eight.png 24x10");
  writePgm16(path("sixteen.pgm"), 7, 33);
  expectPart(expectDone({path("sixteen.pgm"), "--lobes", "2"}), "sixteen.pgm 7x33: 2 lobes");
  Image heights(1, 20, 1);
  for (int y = 0; y < 20; ++y) heights.at(0, y)[0] = 0.1f * std::cos(static_cast<float>(y));
  writeMap("float.exr", heights);
  expectPart(expectDone({path("float.exr"), "--height-scale", "1"}), "float.exr 1x20");
  Image texel(1, 1, 3);
  texel.pixels = {0.5f, 0.5f, 1};
  writeMap("texel.exr", texel);
  expectPart(expectDone({path("texel.exr"), "--lobes", "8"}), "texel.exr 1x1: 8 lobes");
}

TEST_F(FitGmm, FitsTheMapOfASceneWithOverrides) {
  const std::string out =
      expectDone({"--scene", "armour", "--set", "material.gold.normal_map.size_px=48", "--set",
                  "material.gold.normal_map.lobes=3"});
  expectPart(out, "armour 48x48: 3 lobes");
  expectPart(expectDone({"--scene", "armour", "--lobes", "2", "--set",
                         "material.gold.normal_map.size_px=48"}),
             "48x48: 2 lobes");
  expectRefusal({"--scene", "armour", "--material", "tin"}, {"'armour'", "'tin'", "gold"});
  expectRefusal({"--scene", "sponza"}, {"'sponza'", "no normal map"});
  expectRefusal({"--scene", "armour", "disk"}, {"a map or a --scene"});
  expectRefusal({}, {"a map or a --scene"});
}

TEST_F(FitGmm, RefusesBadMapsInOneSentence) {
  expectRefusal({path("missing.png")}, {"missing.png", "neither an image", "disk, armour"});
  std::ofstream(path("noise.png")) << "this is no picture";
  expectRefusal({path("noise.png")}, {"cannot read image", "noise.png"});
  Image down = wave(8, 8);
  down.at(3, 5)[2] = 0;
  down.at(3, 5)[0] = 0.5f;
  writeMap("down.exr", down);
  expectRefusal({path("down.exr")}, {"down.exr", "into the surface", "(3, 5)"});
  Image bent = wave(8, 8);
  for (float& value : bent.pixels) value = 0.5f + 0.4f * (value - 0.5f);
  writeMap("bent.exr", bent);
  expectRefusal({path("bent.exr")}, {"bent.exr", "not unit", "length 1"});
  Image hole(8, 8, 1);
  hole.at(2, 6)[0] = std::numeric_limits<float>::quiet_NaN();
  writeMap("hole.exr", hole);
  expectRefusal({path("hole.exr")}, {"hole.exr", "not finite", "(2, 6)"});
  expectRefusal({path("hole.exr"), "--content", "normals"}, {"hole.exr"});
}

TEST_F(FitGmm, RefusesOptionsOutOfRangeBeforeAnyWork) {
  for (const char* lobes : {"0", "9", "-1"})
    expectRefusal({"disk", "--lobes", lobes}, {"--lobes", lobes, "1 to 8"});
  expectRefusal({"disk", "--lobes", "four"}, {"--lobes", "four"});
  expectRefusal({"disk", "--iterations", "0"}, {"--iterations", "1 to 1000"});
  expectRefusal({"disk", "--passes", "0"}, {"--passes", "1 to 16"});
  expectRefusal({"disk", "--size", "20000"}, {"--size", "1 to 16384"});
  expectRefusal({"disk", "--order", "spiral"}, {"spiral", "colours, scanline"});
  expectRefusal({path("a.png"), "--green", "left"}, {"--green", "up, down"});
  expectRefusal({"disk", "-o", path("missing/a")}, {"missing"});
  expectRefusal({"disk", "--picture", path("a.jpg")}, {"a.jpg", ".png"});
  EXPECT_EQ(folder_.entryCount(), 0u);
}

TEST_F(FitGmm, CachesByContentAndRefitsWhatIsTruncated) {
  writeMap("a.png", wave(16, 16));
  expectPart(expectDone({path("a.png")}), "fitted in");
  expectPart(expectDone({path("a.png")}), "from the cache");
  std::filesystem::rename(path("a.png"), path("b.png"));
  expectPart(expectDone({path("b.png")}), "from the cache");
  EXPECT_EQ(expectDone({path("b.png"), "--refit"}).find("from the cache"), std::string::npos);
  EXPECT_EQ(expectDone({path("b.png"), "--lobes", "3"}).find("from the cache"), std::string::npos);
  for (const auto& entry : std::filesystem::directory_iterator(path("cache")))
    std::filesystem::resize_file(entry.path(), entry.file_size() / 2);
  EXPECT_EQ(expectDone({path("b.png")}).find("from the cache"), std::string::npos);
  expectPart(expectDone({path("b.png")}), "from the cache");
}

TEST_F(FitGmm, WritesMixturesThatItReadsAgainAndPictures) {
  const std::string file = path("disk.mixtures");
  expectDone({"disk", "--size", "32", "-o", file, "--picture", path("disk.png")});
  const Image picture = readImage(path("disk.png"));
  EXPECT_GE(picture.width, 256);
  EXPECT_EQ(picture.channels, 3);
  expectPart(expectDone({"disk", "--size", "32", "--check", file}), "read from " + file);
  expectRefusal({"disk", "--size", "64", "--check", file}, {"32x32", "64x64"});

  const std::string good = readFile(file);
  writeFile(file, good.substr(0, good.size() - 100));
  expectRefusal({"disk", "--size", "32", "--check", file}, {"truncated or damaged", "fit the map"});
  std::string other = good;
  other.replace(other.find('/') + 1, 1, "7");
  writeFile(file, other);
  expectRefusal({"disk", "--size", "32", "--check", file}, {"version 7", "fit the map again"});
  writeFile(file, "something else");
  expectRefusal({"disk", "--size", "32", "--check", file}, {"not a file of mixtures"});
}

// As by a compiler that loses some of what a kernel computes.
TEST_F(FitGmm, MixturesThatLoseNormalsAreRefused) {
  const auto kernels = changedKernels(folder_, "mixture/mixture_texels.clh",
                                      "s->count[i] * inverse", "0.5f * s->count[i] * inverse");
  const ProcessResult result =
      runGlintmark({"fit", "gmm", "--quiet", "disk", "--size", "16", "--on", "device"},
                   {"GLINTMARK_KERNELS=" + kernels.string(), "GLINTMARK_CACHE_DIR=off"});
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_NE(result.err.find("fits mixtures wrongly: weights of a texel's lobes add up to 0.5, not "
                            "to 1; choose another --device or --on host"),
            std::string::npos)
      << result.err;
}

}  // namespace
}  // namespace glintmark
