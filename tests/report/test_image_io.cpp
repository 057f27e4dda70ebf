#include "host/report/picture/image_io.h"
#include "host/report/picture/picture_facts.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <fstream>
#include <limits>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

Image gradient(int width, int height, int channels) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = 0.37f * i - 1;
  return image;
}

TEST(ImageIo, ExrKeepsEveryBitAndChannelName) {
  const TempFolder folder;
  Image image = gradient(7, 5, 5);
  image.channel_names = {"material", "normal.x", "normal.y", "dudx", "depth"};
  image.pixels[3] = std::numeric_limits<float>::infinity();
  image.pixels[4] = 1e-42f;  // subnormal
  writeExr(image, folder / "planes.exr");

  const Image back = readImage(folder / "planes.exr");
  ASSERT_EQ(back.width, 7);
  ASSERT_EQ(back.height, 5);
  ASSERT_EQ(back.channels, 5);
  // EXR stores channels in alphabetical order, so compare by name.
  for (int c = 0; c < 5; ++c) {
    const auto found = std::ranges::find(back.channel_names, image.channel_names[c]);
    ASSERT_NE(found, back.channel_names.end()) << image.channel_names[c];
    const auto other = found - back.channel_names.begin();
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 7; ++x) EXPECT_EQ(image.at(x, y)[c], back.at(x, y)[other]);
    }
  }
  EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(ImageIo, PngRoundsToTheNearestByte) {
  const TempFolder folder;
  Image image(4, 1, 3);
  image.pixels = {0, 1, 0.5f, -3, 7, std::nanf(""), 0.2f, 0.4f, 0.6f, 0.001f, 0.003f, 0.9999f};
  writePng(image, folder / "a.png");
  const Image back = readImage(folder / "a.png");
  const std::vector<int> bytes = {0, 255, 128, 0, 255, 0, 51, 102, 153, 0, 1, 255};
  ASSERT_EQ(back.pixels.size(), bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    EXPECT_NEAR(back.pixels[i] * 255, bytes[i], 1e-4) << i;
  }
}

TEST(ImageIo, ReadsRadianceHdr) {
  const TempFolder folder;
  // A flat 2x1 RGBE file: (mantissa + 0.5) / 256 * 2^(exponent - 128) in OpenEXR terms; the
  // format's own definition without the half is accepted too, so the tolerance is one mantissa
  // step.
  std::ofstream(folder / "a.hdr", std::ios::binary)
      << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
      << std::string("\x80\x40\x20\x81\x80\x80\x80\x8A", 8);
  const Image image = readImage(folder / "a.hdr");
  ASSERT_EQ(image.width, 2);
  ASSERT_EQ(image.channels, 3);
  EXPECT_NEAR(image.at(0, 0)[0], 1.0, 2.0 / 256);
  EXPECT_NEAR(image.at(0, 0)[1], 0.5, 2.0 / 256);
  EXPECT_NEAR(image.at(0, 0)[2], 0.25, 2.0 / 256);
  EXPECT_NEAR(image.at(1, 0)[0], 512.0, 1024.0 / 256);
}

TEST(ImageIo, MissingFileIsNamed) {
  const std::string message = messageOf<Error>([] { readImage("no_such_image.exr"); });
  EXPECT_NE(message.find("no_such_image.exr"), std::string::npos) << message;
}

TEST(ImageIo, DamagedFilesAreErrors) {
  const TempFolder folder;
  writeExr(gradient(64, 64, 3), folder / "whole.exr");
  const std::string bytes = readFile(folder / "whole.exr");
  writeFile(folder / "half.exr", bytes.substr(0, bytes.size() / 2));
  writeFile(folder / "text.png", "this is not a picture");
  EXPECT_THROW(readImage(folder / "half.exr"), Error);
  EXPECT_THROW(readImage(folder / "text.png"), Error);
}

TEST(ImageIo, MissingFolderIsAnErrorAndLeavesNothing) {
  const TempFolder folder;
  const std::string message =
      messageOf<Error>([&] { writeExr(gradient(2, 2, 3), folder / "nowhere/a.exr"); });
  EXPECT_NE(message.find("there is no folder"), std::string::npos) << message;
  EXPECT_EQ(folder.entryCount(), 0u);
}

TEST(ImageIo, FileInPlaceOfAFolderIsAnError) {
  const TempFolder folder;
  writeFile(folder / "file", "");
  EXPECT_THROW(writePng(gradient(2, 2, 3), folder / "file/a.png"), Error);
  EXPECT_THROW(requireWritableFolder(folder / "file"), Error);
  EXPECT_THROW(requireWritableFolder(folder / "file/below"), Error);
  EXPECT_THROW(requireWritableFolder("/proc/glintmark"), Error);
}

TEST(ImageIo, DevicesAreNotReplaced) {
  EXPECT_THROW(writeFile("/dev/full", "x"), Error);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(ImageIo, InconsistentImagesAreErrors) {
  const TempFolder folder;
  EXPECT_THROW(writeExr(Image(0, 4, 3), folder / "a.exr"), Error);
  EXPECT_THROW(writeExr(Image(2, 2, 5), folder / "a.exr"), Error);  // names missing
  EXPECT_THROW(writePng(Image(2, 2, 2), folder / "a.png"), Error);
  Image image(2, 2, 3);
  image.pixels.pop_back();
  EXPECT_THROW(writeExr(image, folder / "a.exr"), Error);
  EXPECT_EQ(folder.entryCount(), 0u);
}

TEST(ImageIo, OnlyKnownExtensions) {
  EXPECT_EQ(requireImageExtension("a/b.EXR"), ".exr");
  EXPECT_EQ(requireImageExtension("a.png"), ".png");
  EXPECT_THROW(requireImageExtension("a.jpg"), Error);
  EXPECT_THROW(requireImageExtension("png"), Error);
}

// A file size limit makes writes fail like a full disk, for root too.
class FullDisk {
 public:
  FullDisk() {
    getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    rlimit small = before_;
    small.rlim_cur = 1000;
    setrlimit(RLIMIT_FSIZE, &small);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(ImageIo, FullDiskKeepsTheOldFile) {
  const TempFolder folder;
  writeFile(folder / "a.json", "old");
  Image noise(64, 64, 3);
  for (std::size_t i = 0; i < noise.pixels.size(); ++i) {
    noise.pixels[i] = static_cast<float>(std::sin(12.9898 * static_cast<double>(i * i)));
  }
  {
    const FullDisk full_disk;
    EXPECT_THROW(writeFile(folder / "a.json", std::string(5000, 'x')), Error);
    EXPECT_THROW(writeExr(noise, folder / "a.exr"), Error);
    EXPECT_THROW(writePng(noise, folder / "a.png"), Error);
  }
  EXPECT_EQ(readFile(folder / "a.json"), "old");
  EXPECT_EQ(folder.entryCount(), 1u);
}

TEST(ImageIo, BandsMakeTheFileOfTheWhole) {
  const TempFolder folder;
  const Image image = gradient(7, 50, 3);  // three bands of 16 rows and one of 2
  std::vector<int> asked;
  const ImageBands bands{.width = 7,
                         .height = 50,
                         .channels = {"R", "G", "B"},
                         .band =
                             [&](int first, int rows) {
                               asked.push_back(rows);
                               Image band(7, rows, 3);
                               for (int y = 0; y < rows; ++y)
                                 for (int x = 0; x < 7; ++x)
                                   std::ranges::copy(image.at(x, first + y), band.at(x, y).begin());
                               return band;
                             },
                         .band_bytes = 1};
  writeExr(bands, folder / "bands.exr", {});
  EXPECT_EQ(asked, (std::vector<int>{16, 16, 16, 2}));
  EXPECT_EQ(readImage(folder / "bands.exr").pixels, image.pixels);
}

}  // namespace
}  // namespace glintmark
