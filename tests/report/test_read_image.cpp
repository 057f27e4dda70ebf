// Image files of others: layers, parts, windows, orientations, greys, damage.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/report/picture/image_io.h"
#include "tests/report/picture_bytes.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

class ImageFiles : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& bytes) const {
    writeFile(folder_ / name, bytes);
    return folder_ / name;
  }
  std::string normalsError(const std::filesystem::path& path) const {
    return messageOf<Error>([&] { readNormals(path); });
  }
  static void expectIn(const std::string& message, std::initializer_list<const char*> parts) {
    for (const char* part : parts)
      EXPECT_NE(message.find(part), std::string::npos) << part << " not in " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }

  const TempFolder folder_;
};

constexpr std::array<int, 4> kTwo{0, 0, 1, 0};  // two pixels side by side

ExrPart part(const std::string& name, const std::vector<std::string>& channels,
             const std::vector<std::vector<float>>& values) {
  return {name, channels, values, kTwo, kTwo};
}

// Unit vectors with a share of every axis.
const std::vector<std::vector<float>> kUnit = {{0.6f, 0}, {0, 0.6f}, {0.8f, 0.8f}};
const std::vector<std::vector<float>> kColour = {{0.1f, 0.1f}, {0.7f, 0.2f}, {0.3f, 0.9f}};

void expectUnit(const Image& image) {
  ASSERT_EQ(image.channels, 3);
  EXPECT_EQ(image.pixels, (std::vector<float>{0.6f, 0, 0.8f, 0, 0.6f, 0.8f}));
}

// More rows than are read at once.
TEST_F(ImageFiles, LargeImagesComeBandByBand) {
  constexpr int kWidth = 1500, kHeight = 3100;  // 56 MB
  Image image(kWidth, kHeight, 3);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      image.at(x, y)[0] = static_cast<float>(x);
      image.at(x, y)[1] = static_cast<float>(y);
      image.at(x, y)[2] = static_cast<float>(x ^ y);
    }
  const std::filesystem::path file = folder_ / "large.exr";
  writeExr(image, file);
  EXPECT_EQ(readColours(file).pixels, image.pixels);
  EXPECT_EQ(normalsSize(file), glm::ivec2(kWidth, kHeight));
  std::string bytes = readFile(file);
  bytes.resize(bytes.size() / 2);
  const std::string cut = messageOf<Error>([&] { readColours(write("cut.exr", bytes)); });
  expectIn(cut, {"cut.exr"});
}

TEST_F(ImageFiles, TheLayerOfNormalsIsFoundByItsName) {
  std::vector<std::vector<float>> values = kColour;
  values.insert(values.begin(), {1, 1});  // alpha
  values.push_back({5, 6});
  values.insert(values.end(), kUnit.begin(), kUnit.end());
  const auto file = write(
      "blender.exr", exrBytes({part("",
                                    {"L.Combined.A", "L.Combined.B", "L.Combined.G", "L.Combined.R",
                                     "L.Depth.Z", "L.Normal.X", "L.Normal.Y", "L.Normal.Z"},
                                    values)}));
  expectUnit(readNormals(file));
  expectUnit(readNormals(file.string() + "#L.Normal"));
  expectUnit(readNormals(file.string() + "#normal"));
  const Image colour = readColours(file);
  EXPECT_EQ(colour.pixels, (std::vector<float>{0.3f, 0.7f, 0.1f, 0.9f, 0.2f, 0.1f}));
  expectIn(normalsError(file.string() + "#Nothing"),
           {"no layer 'Nothing'", "L.Combined, L.Depth, L.Normal"});
}

TEST_F(ImageFiles, ThePartOfNormalsIsFoundByItsNameOrItsVectors) {
  const std::vector<std::vector<float>> unit_bgr = {kUnit[2], kUnit[1], kUnit[0]};
  const auto named = write("named.exr", exrBytes({part("beauty", {"B", "G", "R"}, kColour),
                                                  part("normal", {"B", "G", "R"}, unit_bgr)}));
  expectUnit(readNormals(named));
  EXPECT_EQ(readColours(named).pixels[0], 0.3f);
  expectUnit(readNormals(named.string() + "#normal"));
  EXPECT_EQ(readNormals(named.string() + "#beauty").pixels[0], 0.3f);
  const auto unnamed = write("one.exr", exrBytes({part("first", {"B", "G", "R"}, kColour),
                                                  part("second", {"B", "G", "R"}, unit_bgr)}));
  expectUnit(readNormals(unnamed));
  const auto unclear = write("two.exr", exrBytes({part("first", {"B", "G", "R"}, unit_bgr),
                                                  part("second", {"B", "G", "R"}, unit_bgr)}));
  expectIn(normalsError(unclear), {"two.exr", "#NAME", "first, second"});
}

TEST_F(ImageFiles, AFileMayHaveAHashInItsName) {
  Image image(1, 1, 3);
  image.pixels = {0.5f, 0.5f, 1};
  writeExr(image, folder_ / "a#1.exr");
  EXPECT_EQ(readNormals(folder_ / "a#1.exr").pixels, image.pixels);
}

TEST_F(ImageFiles, DataWindowsArePlacedInTheirDisplayWindow) {
  ExrPart smaller{"", {"Y"}, {{7}}, {1, 1, 1, 1}, {0, 0, 2, 1}};
  const Image framed = readImage(write("small.exr", exrBytes({smaller})));
  EXPECT_EQ(framed.width, 3);
  EXPECT_EQ(framed.pixels, (std::vector<float>{0, 0, 0, 0, 7, 0}));
  ExrPart larger{"", {"Y"}, {{1, 2, 3, 4}}, {-1, -1, 0, 0}, {0, 0, 0, 0}};
  EXPECT_EQ(readImage(write("large.exr", exrBytes({larger}))).pixels, std::vector<float>{4});
  const Image grey = readColours(folder_ / "small.exr");
  EXPECT_EQ(grey.channels, 3);  // a grey picture is one of three equal channels
  EXPECT_EQ(grey.at(1, 1)[2], 7);
}

TEST_F(ImageFiles, OrientationsAreThoseOfAViewer) {
  // 1 2 3 over 4 5 6, as the file has it.
  const std::string pixels = {1, 2, 3, 4, 5, 6};
  const std::vector<std::vector<int>> wanted = {
      {1, 2, 3, 4, 5, 6}, {3, 2, 1, 6, 5, 4}, {6, 5, 4, 3, 2, 1}, {4, 5, 6, 1, 2, 3},
      {1, 4, 2, 5, 3, 6}, {4, 1, 5, 2, 6, 3}, {6, 3, 5, 2, 4, 1}, {3, 6, 2, 5, 1, 4}};
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const Image image = readImage(write("turned.tif", tiffBytes(3, 2, orientation, pixels)));
    EXPECT_EQ(image.width, orientation > 4 ? 2 : 3);
    std::vector<int> values;
    for (const float v : image.pixels) values.push_back(static_cast<int>(std::lround(255 * v)));
    EXPECT_EQ(values, wanted[orientation - 1]) << orientation;
  }
}

TEST_F(ImageFiles, GreysWithAlphaAreHeights) {
  const Image image = readNormals(write("ga.png", pngBytes(2, 1, 8, 4, "\x33\xFF\x66\x80")));
  ASSERT_EQ(image.channels, 1);
  EXPECT_NEAR(image.pixels[0], 0.2, 1e-6);
  EXPECT_NEAR(image.pixels[1], 0.4, 1e-6);  // not multiplied by alpha
  EXPECT_FLOAT_EQ(image.step, 1.0f / 255);
  const Image wide =
      readNormals(write("g16.png", pngBytes(2, 1, 16, 0, std::string("\x80\0\xFF\xFF", 4))));
  EXPECT_NEAR(wide.pixels[0], 32768.0 / 65535, 1e-7);
  EXPECT_FLOAT_EQ(wide.step, 1.0f / 65535);
}

TEST_F(ImageFiles, LuminanceAndChromaAreColours) {
  // Red 0.5, green 0.25, blue 1.
  const float y = 0.2126f * 0.5f + 0.7152f * 0.25f + 0.0722f;
  const Image image = readColours(write(
      "yc.exr",
      exrBytes({part("", {"BY", "RY", "Y"}, {{1 / y - 1, 0}, {0.5f / y - 1, 0}, {y, 0.75f}})})));
  ASSERT_EQ(image.channels, 3);
  const float wanted[] = {0.5f, 0.25f, 1, 0.75f, 0.75f, 0.75f};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(image.pixels[i], wanted[i], 1e-5) << i;
}

// The shares of luminance are those of the primaries: of three at the corners of the chromaticity
// diagram, green alone has any. [SMPTE RP 177]
TEST_F(ImageFiles, LuminanceIsThatOfTheFilesPrimaries) {
  ExrPart own = part("", {"BY", "RY", "Y"}, {{1, 0}, {0.5f, 0}, {2, 0.75f}});
  own.chromaticities = {1, 0, 0, 1, 0, 0, 1 / 3.0f, 1 / 3.0f};
  const Image image = readColours(write("primaries.exr", exrBytes({own})));
  // Of the first pixel, red is (0.5 + 1) 2 and blue (1 + 1) 2.
  const float wanted[] = {3, 2, 4, 0.75f, 0.75f, 0.75f};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(image.pixels[i], wanted[i], 1e-5) << i;
}

// Of primaries that span no colours nothing can be made, and it is said as of any damaged file.
TEST_F(ImageFiles, PrimariesThatSpanNoColoursAreNamed) {
  ExrPart own = part("", {"BY", "RY", "Y"}, {{1, 0}, {0.5f, 0}, {2, 0.75f}});
  const std::vector<std::vector<float>> primaries = {
      {0, 0, 0, 0, 0, 0, 0, 0},
      {0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f, 0.3f},
      {0.64f, 0.33f, 0, 0, 0.15f, 0.06f, 0.3127f, 0.329f}};
  for (const std::vector<float>& bad : primaries) {
    own.chromaticities = bad;
    const std::filesystem::path file = write("bad.exr", exrBytes({own}));
    expectIn(messageOf<Error>([&] { readColours(file); }), {"bad.exr", "chromaticities"});
  }
}

// Chroma of every second pixel each way, in a window that begins at negative numbers: exact on its
// samples, halfway between them, and as the last behind it; luminance is exact everywhere.
TEST_F(ImageFiles, ChromaMayBeStoredForEverySecondPixel) {
  ExrPart sub{
      "", {"BY", "RY", "Y"}, {{0, 1}, {0.5f, -0.5f}, {}}, {-2, 2, 1, 3}, {-2, 2, 1, 3}, {2, 2, 1}};
  for (int i = 1; i <= 8; ++i) sub.values[2].push_back(0.25f * static_cast<float>(i));
  const Image image = readColours(write("sub.exr", exrBytes({sub})));
  ASSERT_EQ(image.channels, 3);
  ASSERT_EQ(image.width, 4);
  ASSERT_EQ(image.height, 2);
  const float red[] = {0.5f, 0, -0.5f, -0.5f}, blue[] = {0, 0.5f, 1, 1};
  for (int i = 0; i < 8; ++i) {
    const float luminance = sub.values[2][i];
    const auto pixel = image.at(i % 4, i / 4);
    EXPECT_NEAR(pixel[0], luminance * (1 + red[i % 4]), 1e-6) << i;
    EXPECT_NEAR(pixel[2], luminance * (1 + blue[i % 4]), 1e-6) << i;
    EXPECT_NEAR(0.2126f * pixel[0] + 0.7152f * pixel[1] + 0.0722f * pixel[2], luminance, 1e-6) << i;
  }
}

// Any channel may be sampled so, in any part and layer, beside channels that are not wanted.
TEST_F(ImageFiles, LayersMayBeSampled) {
  ExrPart layer{"",
                {"A", "eye.BY", "eye.RY", "eye.Y"},
                {{1, 1, 1, 1}, {1}, {0.5f}, {1, 1, 1, 1}},
                {0, 0, 1, 1},
                {0, 0, 1, 1},
                {1, 2, 2, 1}};
  const Image image = readColours(write("eye.exr", exrBytes({layer})).string() + "#eye");
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(image.pixels[3 * i], 1.5f, 1e-6) << i;
  std::vector<ExrPart> parts(2, layer);
  parts[0].name = "first";
  parts[1].name = "second";
  parts[1].values[3] = {2, 2, 2, 2};
  const Image second = readColours(write("two.exr", exrBytes(parts)).string() + "#second.eye");
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(second.pixels[3 * i], 3, 1e-6) << i;
}

TEST_F(ImageFiles, SampledFilesThatEndEarlyAreErrors) {
  const ExrPart sub{"",           {"BY", "RY", "Y"}, {{0}, {0}, {1, 1, 1, 1}},
                    {0, 0, 1, 1}, {0, 0, 1, 1},      {2, 2, 1}};
  const std::string whole = exrBytes({sub});
  EXPECT_EQ(readColours(write("whole.exr", whole)).width, 2);
  for (std::size_t size = 4; size < whole.size(); size += 7)
    EXPECT_THROW(readColours(write("cut.exr", whole.substr(0, size))), Error) << size;
}

TEST_F(ImageFiles, SizesAreCheckedBeforeMemoryIsTaken) {
  for (const auto& [width, height] : {std::pair{60000, 60000}, std::pair{40000, 1}})
    expectIn(normalsError(write("bomb.png", pngBytes(width, height, 8, 2, ""))),
             {"bomb.png", "pixels", "32768"});
}

TEST_F(ImageFiles, TruncatedFilesAreErrors) {
  std::string jpeg;
  {
    std::uint32_t bits = 0;
    int count = 0;
    for (const char* c = kNoiseJpeg; *c != '\0' && *c != '='; ++c) {
      const std::string_view digits =
          "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
      bits = bits << 6 | static_cast<std::uint32_t>(digits.find(*c));
      if (++count % 4 != 1) jpeg += static_cast<char>(bits >> (6 - 2 * ((count - 1) % 4)) & 0xFF);
    }
  }
  EXPECT_EQ(readImage(write("whole.jpg", jpeg)).width, 40);
  for (std::size_t size = 100; size < jpeg.size() - 2; size += 41)
    EXPECT_THROW(readImage(write("cut.jpg", jpeg.substr(0, size))), Error) << size;
  const std::string png = pngBytes(8, 8, 8, 2, std::string(8 * 8 * 3, '\x40'));
  for (std::size_t size = 10; size < png.size() - 12; size += 7)
    EXPECT_THROW(readImage(write("cut.png", png.substr(0, size))), Error) << size;
}

TEST_F(ImageFiles, WhatHasNoEndIsRefused) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.png").c_str(), 0600), 0);
  expectIn(normalsError(folder_ / "pipe.png"), {"pipe.png", "a pipe"});
  expectIn(normalsError("/dev/zero"), {"/dev/zero", "a device"});
}

TEST_F(ImageFiles, PicturesInMemoryAreRead) {
  const std::string png = pngBytes(1, 1, 8, 2, "\x80\x80\xFF");
  EXPECT_EQ(decodeNormals(png, "inside").channels, 3);
  expectIn(messageOf<Error>([] { decodeNormals("none", "inside"); }), {"inside"});
}

}  // namespace
}  // namespace glintmark
