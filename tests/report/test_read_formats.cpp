// Formats of others than EXR and PNG of plain colours: every way in which their rows and numbers
// may lie, written byte by byte.
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/report/picture/image_io.h"
#include "tests/report/picture_bytes.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

class ImageFormats : public testing::Test {
 protected:
  Image read(const std::string& name, const std::string& bytes) const {
    writeFile(folder_ / name, bytes);
    return readColours(folder_ / name);
  }

  const TempFolder folder_;
};

/// Red of each pixel in steps of 1 / 255, row by row.
std::vector<int> reds(const Image& image) {
  std::vector<int> values;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      values.push_back(static_cast<int>(std::lround(255 * image.at(x, y)[0])));
  return values;
}

const std::vector<int> kUpright = {10, 20, 30, 40, 50, 60};  // of 3x2 pixels

/// Pixels of one colour channel each, blue, green and red alike, in that order of `values`.
std::string greys(const std::vector<int>& values) {
  std::string bytes;
  for (const int v : values) bytes += std::string(3, static_cast<char>(v));
  return bytes;
}

// Eight ways to write a picture: which axis the scanlines go along, and which way each goes. [Ward,
// "Radiance File Formats", picture files]
TEST_F(ImageFormats, RadianceOfAnyOrientation) {
  const std::pair<const char*, std::vector<int>> kWays[] = {
      {"-Y 2 +X 3", {10, 20, 30, 40, 50, 60}}, {"-Y 2 -X 3", {30, 20, 10, 60, 50, 40}},
      {"+Y 2 +X 3", {40, 50, 60, 10, 20, 30}}, {"+Y 2 -X 3", {60, 50, 40, 30, 20, 10}},
      {"+X 3 -Y 2", {10, 40, 20, 50, 30, 60}}, {"+X 3 +Y 2", {40, 10, 50, 20, 60, 30}},
      {"-X 3 -Y 2", {30, 60, 20, 50, 10, 40}}, {"-X 3 +Y 2", {60, 30, 50, 20, 40, 10}}};
  for (const auto& [way, values] : kWays) {
    std::string file = std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n") + way + "\n";
    for (const int v : values)  // v / 256: the exponent of 128 is 0
      file += std::string{static_cast<char>(v), 0, 0, static_cast<char>(128)};
    const Image image = read("way.hdr", file);
    ASSERT_EQ(image.width, 3) << way;
    ASSERT_EQ(image.height, 2) << way;
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(image.at(i % 3, i / 3)[0], kUpright[i] / 256.0, 0.5 / 256) << way << " " << i;
  }
}

TEST_F(ImageFormats, PalettesAreTheirColours) {
  // Four indices of two bits to a byte; entries 0 to 3.
  const std::string palette = greys({10, 20, 30, 40});
  const auto png = [&](const std::string& more) {
    const std::string plain = pngBytes(4, 1, 2, 3, std::string(1, '\x1B'));  // 0 1 2 3
    const std::size_t head = 8 + 12 + 13;
    return plain.substr(0, head) + pngChunk("PLTE", palette) + more + plain.substr(head);
  };
  EXPECT_EQ(reds(read("palette.png", png(""))), (std::vector<int>{10, 20, 30, 40}));
  // Transparency hides nothing of a colour.
  EXPECT_EQ(reds(read("clear.png", png(pngChunk("tRNS", std::string(2, '\0'))))),
            (std::vector<int>{10, 20, 30, 40}));
}

TEST_F(ImageFormats, DeepGreysWithAlpha) {
  std::string pixels;
  for (const int v : {0x2000, 0x8001})
    pixels += std::string{static_cast<char>(v >> 8), static_cast<char>(v & 0xFF), 0, 0};
  const Image image = read("deep.png", pngBytes(2, 1, 16, 4, pixels));
  EXPECT_NEAR(image.at(0, 0)[0], 0x2000 / 65535.0, 1e-6);
  EXPECT_NEAR(image.at(1, 0)[2], 0x8001 / 65535.0, 1e-6);
}

// A descriptor's bit 5: the first row is the top one.
TEST_F(ImageFormats, TargaFromTheBottomAndTheTop) {
  for (const bool from_top : {false, true}) {
    const std::vector<int> stored = from_top ? kUpright : std::vector<int>{40, 50, 60, 10, 20, 30};
    std::string file = {0, 0, 2, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3, 0, 2, 0, 24};
    file += from_top ? '\x20' : '\0';
    EXPECT_EQ(reds(read("rows.tga", file + greys(stored))), kUpright) << from_top;
    EXPECT_THROW(read("cut.tga", (file + greys(stored)).substr(0, 30)), Error);
  }
}

// A negative height: the first row is the top one. Rows are padded to four bytes.
TEST_F(ImageFormats, BitmapsFromTheBottomAndTheTop) {
  for (const int height : {2, -2}) {
    const std::vector<int> stored =
        height < 0 ? kUpright : std::vector<int>{40, 50, 60, 10, 20, 30};
    std::string rows;
    for (int y = 0; y < 2; ++y)
      rows += greys({stored.begin() + 3 * y, stored.begin() + 3 * y + 3}) + std::string(3, '\0');
    const auto whole = [](int v) { return littleEndian(std::int32_t{v}); };
    const std::string file = "BM" + whole(54 + 24) + whole(0) + whole(54) + whole(40) + whole(3) +
                             whole(height) + littleEndian(std::int16_t{1}) +
                             littleEndian(std::int16_t{24}) + whole(0) + whole(24) + whole(0) +
                             whole(0) + whole(0) + whole(0) + rows;
    EXPECT_EQ(reds(read("rows.bmp", file)), kUpright) << height;
  }
}

// What OpenImageIO 2.4 gives other pixels for.
/// A chunk of a RIFF file.
std::string riff(const std::string& name, const std::string& content) {
  return name + littleEndian(static_cast<std::uint32_t>(content.size())) + content +
         std::string(content.size() % 2, '\0');
}

// Lossless: a red pixel beside a blue one.
const std::string kWebpPixels(
    "\x2f\x01\x00\x00\x00\x0f\x10\xf3\xbf\xff\xf3\x1f\x0e\x32\xa2\xff\x01", 17);

// Exif of big and of little endian machines, with the mark of JPEG's and without.
TEST_F(ImageFormats, WebpLiesAsItsExifSays) {
  const auto file = [](const std::string& exif) {
    const std::string flags{8, 0, 0, 0, 1, 0, 0, 0, 0, 0};  // has Exif, is 2x1
    return riff("RIFF",
                "WEBP" + riff("VP8X", flags) + riff("VP8L", kWebpPixels) + riff("EXIF", exif));
  };
  const auto orientation = [](char value, bool big) {
    if (big)
      return std::string("MM\0*\0\0\0\x08\0\1\x01\x12\0\3\0\0\0\1\0", 19) + value +
             std::string(6, '\0');
    return std::string("II*\0\x08\0\0\0\1\0\x12\x01\3\0\1\0\0\0", 18) + value +
           std::string(7, '\0');
  };
  EXPECT_EQ(reds(read("plain.webp", riff("RIFF", "WEBP" + riff("VP8L", kWebpPixels)))),
            (std::vector<int>{255, 0}));
  for (const bool big : {false, true}) {
    EXPECT_EQ(reds(read("1.webp", file(orientation(1, big)))), (std::vector<int>{255, 0}));
    EXPECT_EQ(reds(read("3.webp", file(orientation(3, big)))), (std::vector<int>{0, 255}));
    const Image turned = read("6.webp", file(std::string("Exif\0\0", 6) + orientation(6, big)));
    EXPECT_EQ(turned.height, 2);
    EXPECT_EQ(reds(turned), (std::vector<int>{255, 0}));
    EXPECT_EQ(reds(read("8.webp", file(orientation(8, big)))), (std::vector<int>{0, 255}));
    EXPECT_EQ(normalsSize(folder_ / "8.webp"), glm::ivec2(1, 2));
  }
  // Damaged Exif says nothing.
  for (const std::string& exif : {std::string(), std::string("II*"), std::string(40, '\xff'),
                                  orientation(6, true).substr(0, 15), orientation(99, false)})
    EXPECT_EQ(reds(read("bad.webp", file(exif))), (std::vector<int>{255, 0}));
}

TEST_F(ImageFormats, TransparentWebpIsRefused) {
  const std::string clear(
      "\x2f\x01\x00\x00\x10\x0f\x10\xfb\x3f\xff\xa7\xf9\x8f\x0a\x15\x88\xe8\x7f\x00", 19);
  const std::string file = riff("RIFF", "WEBP" + riff("VP8L", clear));
  EXPECT_NE(messageOf<Error>([&] { read("clear.webp", file); }).find("transparent in places"),
            std::string::npos);
}

TEST_F(ImageFormats, DpxOfColumnsIsRefused) {
  for (const bool big : {false, true})
    for (int orientation = 0; orientation < 8; ++orientation) {
      std::string file(2048, '\0');
      file.replace(0, 4, big ? "SDPX" : "XPDS");
      file[768 + (big ? 1 : 0)] = static_cast<char>(orientation);
      const std::string text = messageOf<Error>([&] { read("film.dpx", file); });
      EXPECT_EQ(text.find("in columns") != std::string::npos, orientation >= 4) << text;
    }
}

// Without the tag a sample has one bit; OpenImageIO reads it as if it had eight.
TEST_F(ImageFormats, TiffWithoutBitsPerSampleIsRefused) {
  std::string file = tiffBytes(3, 2, 1, {1, 2, 3, 4, 5, 6});
  EXPECT_EQ(read("grey.tif", file).pixels.size(), 18u);
  const std::size_t tag =
      file.find(littleEndian(std::uint16_t{258}) + littleEndian(std::uint16_t{3}));
  ASSERT_NE(tag, std::string::npos);
  file.replace(tag, 2,
               littleEndian(std::uint16_t{257 + 8}));  // another tag that means nothing here
  EXPECT_NE(messageOf<Error>([&] { read("bits.tif", file); }).find("how many bits a sample has"),
            std::string::npos);
}

// A file of a few bytes may say that it is large: nothing of that size is filled before its first
// rows turn out not to be there.
TEST_F(ImageFormats, LargePicturesWithoutPixelsAreRefusedAtOnce) {
  const std::clock_t start = std::clock();
  const std::string shapes[] = {"P6\n20000 20000\n255\n", "PF\n20000 20000\n-1.0\n",
                                "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 20000 +X 20000\n"};
  const char* names[] = {"large.ppm", "large.pfm", "large.hdr"};
  for (int i = 0; i < 3; ++i) {
    const std::string text = messageOf<Error>([&] { read(names[i], shapes[i]); });
    EXPECT_NE(text.find(names[i]), std::string::npos) << text;
  }
  const double taken_s = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  EXPECT_LT(taken_s, 1.5) << "20000x20000 pixels of three floats take longer to clear";
}

TEST_F(ImageFormats, WhatWouldBeReadWronglyIsRefused) {
  const auto complaint = [&](const std::string& name, const std::string& bytes) {
    return messageOf<Error>([&] { read(name, bytes); });
  };
  std::string dds = "DDS " + littleEndian(std::uint32_t{124}) +
                    littleEndian(std::uint32_t{0x1007}) + littleEndian(std::uint32_t{2}) +
                    littleEndian(std::uint32_t{2});
  dds.resize(76, '\0');
  dds += littleEndian(std::uint32_t{32}) + littleEndian(std::uint32_t{0x20000}) +
         littleEndian(std::uint32_t{0}) + littleEndian(std::uint32_t{8}) +
         littleEndian(std::uint32_t{0xFF});
  dds.resize(108, '\0');
  dds += littleEndian(std::uint32_t{0x1000});
  dds.resize(128, '\0');
  EXPECT_NE(complaint("l.dds", dds + "\x10\x20\x30\x40").find("luminance"), std::string::npos);

  const auto bmp = [](std::uint32_t red, std::uint32_t green, std::uint32_t blue) {
    std::string bytes = "BM" + littleEndian(std::uint32_t{74}) + littleEndian(std::uint32_t{0}) +
                        littleEndian(std::uint32_t{70}) + littleEndian(std::uint32_t{56}) +
                        littleEndian(std::uint32_t{1}) + littleEndian(std::uint32_t{1}) +
                        littleEndian(std::uint16_t{1}) + littleEndian(std::uint16_t{32}) +
                        littleEndian(std::uint32_t{3});
    bytes.resize(54, '\0');
    return bytes + littleEndian(red) + littleEndian(green) + littleEndian(blue) +
           littleEndian(std::uint32_t{0xFF000000u}) + "\x10\x20\x30\x40";
  };
  EXPECT_NE(complaint("m.bmp", bmp(0xFF, 0xFF00, 0xFF0000)).find("bit masks"), std::string::npos);
  EXPECT_EQ(reds(read("n.bmp", bmp(0xFF0000, 0xFF00, 0xFF))), (std::vector<int>{0x30}));

  const auto tga = [](char first) {
    std::string bytes("\0\1\1", 3);
    bytes += first;
    bytes += std::string("\0\2\0\x18\0\0\0\0\1\0\1\0\x08\x20", 14);
    return bytes + greys({70, 80}) + '\1';
  };
  EXPECT_NE(complaint("s.TGA", tga(1)).find("colour map"), std::string::npos);
  EXPECT_EQ(reds(read("t.tga", tga(0))), (std::vector<int>{80}));
}

TEST_F(ImageFormats, WhatIsOfNoPictureFormatIsSaid) {
  const std::string message = messageOf<Error>([&] { read("a.ktx2", "\xABKTX 20\xBB\r\n\x1A\n"); });
  EXPECT_NE(message.find("a.ktx2: it is of no picture format"), std::string::npos) << message;
}

}  // namespace
}  // namespace glintmark
