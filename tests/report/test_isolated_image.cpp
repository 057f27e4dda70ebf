// Images read in a process of their own: what comes over, and what becomes of faults.
#include "host/report/picture/isolated_image.h"

#include <gtest/gtest.h>

#include <csignal>
#include <new>

#include "host/core/error.h"
#include "tests/report/temp_folder.h"

namespace glintmark {
namespace {

enum class Fault { kNone, kAtOpening, kCrashAtOpening, kCrashAtReading, kWarning, kMemory };

class FakeImage : public StoredImage {
 public:
  explicit FakeImage(Fault fault) : fault_(fault) {}

  std::optional<StoredPart> part(int number) override {
    if (number > 1) return std::nullopt;
    StoredPart part{.name = "part " + std::to_string(number), .channel_names = {"R", "long name"}};
    part.x = -1, part.y = 2, part.width = 3, part.height = 4, part.depth = 5;
    part.full_x = 6, part.full_y = 7, part.full_width = 8, part.full_height = 9;
    part.orientation = 3, part.band_rows = 11, part.step = 0.25f, part.deep = true;
    part.luminance = {0.5f, 0.25f, 0.125f};
    return part;
  }
  bool hasParts() const override { return true; }
  std::string read(int part, int begin, int end, int first_row, int rows,
                   std::span<float> pixels) override {
    if (fault_ == Fault::kCrashAtReading) std::raise(SIGSEGV);
    if (fault_ == Fault::kWarning) return "it is odd";
    if (fault_ == Fault::kMemory) throw std::bad_alloc();
    for (std::size_t i = 0; i < pixels.size(); ++i)
      pixels[i] = static_cast<float>(static_cast<int>(i) + 10000 * rows + 100000 * first_row +
                                     1000 * part + 100 * begin + 10 * end);
    return {};
  }

 private:
  Fault fault_;
};

class FakeCodec : public ImageCodec {
 public:
  explicit FakeCodec(Fault fault) : fault_(fault) {}

  std::unique_ptr<StoredImage> open(const std::string&, std::string& fault) const override {
    if (fault_ == Fault::kCrashAtOpening) std::raise(SIGABRT);
    if (fault_ != Fault::kAtOpening) return std::make_unique<FakeImage>(fault_);
    fault = "no image";
    return nullptr;
  }
  std::unique_ptr<StoredImage> open(const std::string& format, std::span<const char> bytes,
                                    std::string& fault) const override {
    fault = format + std::string(bytes.begin(), bytes.end());
    return nullptr;
  }
  std::vector<unsigned char> encode(const PixelBlock&, std::string&) const override { return {}; }
  InkBox inkBox(const std::string&, int, const std::string&) const override { return {}; }
  std::string drawInk(const std::string&, int, const std::string&, const InkBox&,
                      std::span<float>) const override {
    return {};
  }

 private:
  Fault fault_;
};

// The program's own file is one that is there.
std::unique_ptr<StoredImage> openFake(Fault kind, std::string& fault) {
  return openIsolated(FakeCodec(kind), "/proc/self/exe", {}, fault);
}

TEST(IsolatedImage, EverythingComesOver) {
  std::string fault;
  const auto image = openFake(Fault::kNone, fault);
  ASSERT_NE(image, nullptr);
  EXPECT_TRUE(image->hasParts());
  EXPECT_FALSE(image->part(2).has_value());
  const StoredPart part = image->part(1).value();
  EXPECT_EQ(part.name, "part 1");
  EXPECT_EQ(part.channel_names, (std::vector<std::string>{"R", "long name"}));
  EXPECT_EQ((std::array{part.x, part.y, part.width, part.height, part.depth}),
            (std::array{-1, 2, 3, 4, 5}));
  EXPECT_EQ((std::array{part.full_x, part.full_y, part.full_width, part.full_height}),
            (std::array{6, 7, 8, 9}));
  EXPECT_EQ(part.orientation, 3);
  EXPECT_EQ(part.step, 0.25f);
  EXPECT_EQ(part.band_rows, 11);
  EXPECT_TRUE(part.deep);
  EXPECT_EQ(part.luminance, (std::array{0.5f, 0.25f, 0.125f}));
  std::vector<float> pixels(300000);
  EXPECT_EQ(image->read(1, 2, 3, 5, 4, pixels), "");
  for (std::size_t i = 0; i < pixels.size(); ++i)
    ASSERT_EQ(pixels[i], static_cast<float>(541230 + static_cast<int>(i)));
}

TEST(IsolatedImage, FaultsAreSentences) {
  std::string fault;
  EXPECT_EQ(openFake(Fault::kAtOpening, fault), nullptr);
  EXPECT_EQ(fault, "no image");
  EXPECT_EQ(openIsolated(FakeCodec(Fault::kNone), "name", {"png", " bytes"}, fault), nullptr);
  EXPECT_EQ(fault, "png bytes");
  const std::string opening = messageOf<Error>([&] { openFake(Fault::kCrashAtOpening, fault); });
  EXPECT_NE(opening.find("was ended by signal 6"), std::string::npos) << opening;
  std::vector<float> pixels(10);
  EXPECT_EQ(openFake(Fault::kWarning, fault)->read(0, 0, 1, 0, 1, pixels), "it is odd");
  EXPECT_NE(openFake(Fault::kMemory, fault)->read(0, 0, 1, 0, 1, pixels).find("memory"),
            std::string::npos);
  const auto image = openFake(Fault::kCrashAtReading, fault);
  const std::string reading = messageOf<Error>([&] { image->read(0, 0, 1, 0, 1, pixels); });
  EXPECT_NE(reading.find("/proc/self/exe"), std::string::npos) << reading;
  EXPECT_NE(reading.find("was ended by signal 11"), std::string::npos) << reading;
}

}  // namespace
}  // namespace glintmark
