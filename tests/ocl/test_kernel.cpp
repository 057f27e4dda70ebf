#include <vector>

#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

constexpr std::size_t kSmallGrid = 1000;   // work-items, below PoCL's limit of 2^16
constexpr std::size_t kLargeGrid = 70000;  // and above

class KernelTest : public OclTest {
 protected:
  Device device_;
  ProgramCache cache_{device_};
  Program program_ = cache_.getWithOptions("tiny.cl", "");
  Buffer values_{device_, kLargeGrid * 4, BufferPurpose::kProbe};
};

TEST_F(KernelTest, RangeIsRoundedUpToTheLocalSize) {
  values_.fillZero();
  const KernelArg args[] = {values_, std::uint32_t{kLargeGrid}};
  program_.kernel("count").launch(args, 33, 32);
  std::vector<std::uint32_t> back(65);
  values_.read(back.data(), 65 * 4);
  for (std::size_t i = 0; i < 65; ++i) EXPECT_EQ(back[i], i < 64 ? 3u : 0u) << i;
}

TEST_F(KernelTest, TimesAreSane) {
  const KernelArg args[] = {values_, std::uint32_t{kLargeGrid}};
  Kernel count = program_.kernel("count");
  for (int i = 0; i < 5; ++i) {
    const LaunchTimes times = count.launch(args, kLargeGrid, 64);
    EXPECT_GT(times.event_ns, 0);
    EXPECT_GE(times.wall_ns, times.event_ns);
    EXPECT_LT(times.wall_ns, 60e9);
    EXPECT_EQ(times.event_ns, static_cast<double>(static_cast<std::uint64_t>(times.event_ns)))
        << "whole nanoseconds";
  }
}

TEST_F(KernelTest, FirstEnqueueIsAccountedApart) {
  const KernelArg args[] = {values_, std::uint32_t{kLargeGrid}};
  Kernel count = program_.kernel("count");
  EXPECT_EQ(count.firstEnqueueNs(), 0);
  const LaunchTimes first = count.launch(args, kSmallGrid, 64);
  EXPECT_TRUE(first.first_enqueue);
  EXPECT_EQ(count.firstEnqueueNs(), first.wall_ns);
  EXPECT_FALSE(count.launch(args, kSmallGrid, 64).first_enqueue);
  EXPECT_EQ(count.firstEnqueueNs(), first.wall_ns);

  const LaunchTimes other_size = count.launch(args, kSmallGrid, 32);
  const LaunchTimes other_grid = count.launch(args, kLargeGrid, 64);
  EXPECT_TRUE(other_size.first_enqueue);
  EXPECT_TRUE(other_grid.first_enqueue);
  EXPECT_FALSE(program_.kernel("count").launch(args, kLargeGrid, 64).first_enqueue)
      << "kernels of one name share their history";
  EXPECT_EQ(count.firstEnqueueNs(), first.wall_ns + other_size.wall_ns + other_grid.wall_ns);
}

TEST_F(KernelTest, EmptyRangeDoesNothing) {
  values_.fillZero();
  const KernelArg args[] = {values_, std::uint32_t{kLargeGrid}};
  Kernel count = program_.kernel("count");
  const LaunchTimes times = count.launch(args, 0, 64);
  EXPECT_EQ(times.event_ns, 0);
  EXPECT_EQ(times.wall_ns, 0);
  EXPECT_FALSE(times.first_enqueue);
  EXPECT_EQ(count.firstEnqueueNs(), 0);
  std::uint32_t first = 1;
  values_.read(&first, 4);
  EXPECT_EQ(first, 0u);
}

TEST_F(KernelTest, ScalarsArriveAsWhatTheyAre) {
  const KernelArg args[] = {values_, std::int32_t{-5}, std::uint32_t{0x80000000u}, 0.375f};
  program_.kernel("scalars").launch(args, 1, 1);
  float back[3] = {};
  values_.read(back, sizeof back);
  EXPECT_EQ(back[0], -5.0f);
  EXPECT_EQ(back[1], 2147483648.0f);
  EXPECT_EQ(back[2], 0.375f);
}

TEST_F(KernelTest, MisuseIsOneSentence) {
  Kernel count = program_.kernel("count");
  const KernelArg one[] = {values_};
  EXPECT_EQ(errorOf([&] { count.launch(one, 1, 1); }),
            "kernel 'count' takes 2 arguments, but 1 were given");
  const KernelArg empty[] = {Buffer(), std::uint32_t{1}};
  EXPECT_EQ(errorOf([&] { count.launch(empty, 1, 1); }),
            "argument 0 of kernel 'count' is an empty buffer; it must be allocated first");
  const KernelArg good[] = {values_, std::uint32_t{1}};
  EXPECT_EQ(errorOf([&] { count.launch(good, 1, 0); }),
            "kernel 'count' needs a local size of at least 1");
  EXPECT_EQ(errorOf([&] { Kernel().launch(good, 1, 1); }),
            "an empty kernel was launched; it must come from a program");
}

// tests/faulty_driver has drivers that refuse what they said they take.
TEST_F(KernelTest, GroupsThatAreTooLargeAreMadeSmaller) {
  const KernelArg args[] = {values_, std::uint32_t{1}};
  const std::size_t too_many = device_.info().max_work_group_size * std::size_t{2};
  EXPECT_NO_THROW(program_.kernel("count").launch(args, too_many, too_many));
}

TEST_F(KernelTest, UnknownKernelListsTheKnown) {
  const std::string message = errorOf([&] { program_.kernel("shade"); });
  EXPECT_TRUE(message.starts_with("kernel file 'tiny.cl' has no kernel 'shade'; it has "))
      << message;
  EXPECT_NE(message.find("count"), std::string::npos) << message;
  EXPECT_EQ(errorOf([&] { Program().kernel("x"); }),
            "an empty program was used; it must come from a program cache");
}

}  // namespace
}  // namespace glintmark
