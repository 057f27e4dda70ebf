#include <cstdlib>
#include <memory>
#include <numeric>
#include <vector>

#include "host/ocl/upload.h"
#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

constexpr std::size_t kWords = 5000;  // not a multiple of a page
constexpr std::uint32_t kStep = 3;    // what tiny.cl's "count" adds

class BufferTest : public OclTest {
 protected:
  Device device_;
};

std::vector<std::uint32_t> ascending() {
  std::vector<std::uint32_t> words(kWords);
  std::iota(words.begin(), words.end(), 7u);
  return words;
}

TEST_F(BufferTest, FreshMemoryGivesBackWhatWasWritten) {
  Buffer buffer(device_, kWords * 4, BufferPurpose::kProbe, "words");
  EXPECT_EQ(buffer.bytes(), kWords * 4);
  const std::vector<std::uint32_t> words = ascending();
  EXPECT_GE(buffer.write(words.data(), kWords * 4), 0);
  std::vector<std::uint32_t> back(kWords);
  EXPECT_GE(buffer.read(back.data(), kWords * 4), 0);
  EXPECT_EQ(back, words);
}

TEST_F(BufferTest, OffsetsAddressAPart) {
  Buffer buffer(device_, kWords * 4, BufferPurpose::kProbe, "words");
  buffer.fillZero();
  const std::uint32_t value = 42;
  buffer.write(&value, 4, 400);
  std::vector<std::uint32_t> back(3);
  buffer.read(back.data(), 12, 396);
  EXPECT_EQ(back, (std::vector<std::uint32_t>{0, 42, 0}));
}

TEST_F(BufferTest, FillZeroClearsAll) {
  Buffer buffer(device_, kWords * 4, BufferPurpose::kProbe, "words");
  buffer.write(ascending().data(), kWords * 4);
  buffer.fillZero();
  std::vector<std::uint32_t> back(kWords, 1);
  buffer.read(back.data(), kWords * 4);
  EXPECT_EQ(back, std::vector<std::uint32_t>(kWords, 0));
}

TEST_F(BufferTest, WrappedMemoryReachesTheKernelAndBack) {
  const std::unique_ptr<std::uint32_t, decltype(&std::free)> memory(
      static_cast<std::uint32_t*>(std::aligned_alloc(4096, 5 * 4096)), std::free);
  Buffer buffer =
      Buffer::wrapHost(device_, memory.get(), kWords * 4, BufferPurpose::kProbe, "planes");
  ProgramCache cache(device_);
  Kernel count = cache.getWithOptions("tiny.cl", "").kernel("count");
  const KernelArg args[] = {buffer, static_cast<std::uint32_t>(kWords)};

  std::vector<std::uint32_t> expected = ascending();
  for (int frame = 0; frame < 3; ++frame) {  // host memory is rewritten in place, frame by frame
    for (std::size_t i = 0; i < kWords; ++i) memory.get()[i] = expected[i] + 100u * frame;
    buffer.write(memory.get(), kWords * 4);
    count.launch(args, kWords, 64);
    std::vector<std::uint32_t> copy(kWords);
    buffer.read(copy.data(), kWords * 4);
    buffer.read(memory.get(), kWords * 4);
    for (std::size_t i = 0; i < kWords; ++i) {
      ASSERT_EQ(copy[i], expected[i] + 100u * frame + kStep) << frame << " " << i;
      ASSERT_EQ(memory.get()[i], copy[i]) << frame << " " << i;
    }
  }
}

TEST_F(BufferTest, TakenMemoryIsTheBuffersOwn) {
  for (const std::size_t words : {std::size_t{1000}, kLeastLargeBytes / 4, std::size_t{3} << 20}) {
    LargeArray<std::uint32_t> items(words);
    for (std::size_t i = 0; i < words; ++i) items[i] = static_cast<std::uint32_t>(3 * i + 1);
    const LargeArray<std::uint32_t> expected = items;
    Buffer buffer = upload(device_, std::move(items), BufferPurpose::kProbe, "taken");
    EXPECT_EQ(buffer.bytes(), words * 4);
    EXPECT_EQ(device_.bufferUse().total.held, words * 4);
    LargeArray<std::uint32_t> back(words);
    buffer.read(back.data(), words * 4);
    EXPECT_EQ(back, expected);
  }
  EXPECT_EQ(device_.bufferUse().total.held, 0u);
}

TEST_F(BufferTest, ZeroBytesStillMakesABuffer) {
  Buffer buffer(device_, 0, BufferPurpose::kProbe, "nothing");
  EXPECT_EQ(buffer.bytes(), 4u);
  EXPECT_FALSE(buffer.empty());
  EXPECT_TRUE(Buffer().empty());
  EXPECT_EQ(Buffer().bytes(), 0u);
}

TEST_F(BufferTest, TooLargeNamesTheThingAndTheLimit) {
  const DeviceInfo& info = device_.info();
  const std::string message = errorOf(
      [&] { Buffer(device_, info.max_alloc_bytes + 1, BufferPurpose::kProbe, "radiance"); });
  EXPECT_TRUE(message.starts_with("radiance needs ")) << message;
  EXPECT_NE(message.find(" MiB, but '" + info.name + "' allows at most "), std::string::npos)
      << message;
}

TEST_F(BufferTest, RangesOutsideAreRefused) {
  Buffer buffer(device_, 16, BufferPurpose::kProbe, "words");
  char bytes[32] = {};
  EXPECT_EQ(errorOf([&] { buffer.write(bytes, 17); }),
            "cannot write 17 bytes at offset 0 of words, which has 16 bytes");
  EXPECT_EQ(errorOf([&] { buffer.read(bytes, 8, 12); }),
            "cannot read 8 bytes at offset 12 of words, which has 16 bytes");
  EXPECT_EQ(errorOf([&] { buffer.read(bytes, ~std::size_t{0}, 12); }),
            "cannot read 18446744073709551615 bytes at offset 12 of words, which has 16 bytes");
  EXPECT_EQ(errorOf([&] { Buffer().read(bytes, 1); }),
            "an empty device buffer was used; it must be allocated first");
}

TEST_F(BufferTest, WrappingNeedsAlignedMemory) {
  alignas(4096) static char page[8192];
  EXPECT_EQ(
      errorOf([&] { Buffer::wrapHost(device_, page + 64, 64, BufferPurpose::kProbe, "planes"); }),
      "planes cannot be wrapped because it is not aligned to 4096 bytes");
  EXPECT_EQ(
      errorOf([&] { Buffer::wrapHost(device_, nullptr, 64, BufferPurpose::kProbe, "planes"); }),
      "planes cannot be wrapped because it is not aligned to 4096 bytes");
  EXPECT_EQ(errorOf([&] { Buffer::wrapHost(device_, page, 0, BufferPurpose::kProbe, "planes"); }),
            "planes has no bytes to wrap; at least one is needed");
}

TEST_F(BufferTest, DeviceKnowsWhatIsHeldAndWhatWas) {
  EXPECT_EQ(device_.bufferUse().total.held, 0u);
  Buffer words(device_, 4000, BufferPurpose::kProbe, "words");
  {
    const Buffer more(device_, 400, BufferPurpose::kProbe, "words"),
        other(device_, 40, BufferPurpose::kLights);
    const Buffer same = more;  // NOLINT: a second handle is no second buffer
    EXPECT_EQ(device_.bufferUse().by_purpose.at(BufferPurpose::kProbe).held, 4400u);
    EXPECT_EQ(device_.bufferUse().total.held, 4440u);
  }
  const BufferUse use = device_.bufferUse();
  EXPECT_EQ(use.by_purpose.at(BufferPurpose::kProbe).held, 4000u);
  EXPECT_EQ(use.by_purpose.at(BufferPurpose::kProbe).peak, 4400u);
  EXPECT_EQ(use.by_purpose.at(BufferPurpose::kLights).held, 0u);
  EXPECT_EQ(use.total.peak, 4440u);
  device_.resetBufferPeaks();
  EXPECT_FALSE(device_.bufferUse().by_purpose.contains(BufferPurpose::kLights));
  EXPECT_EQ(device_.bufferUse().total.peak, 4000u);
  EXPECT_THROW(
      Buffer(device_, device_.info().max_alloc_bytes + 1, BufferPurpose::kProbe, "too much"),
      Error);
  EXPECT_EQ(device_.bufferUse().total.held, 4000u);
}

}  // namespace
}  // namespace glintmark
