#include "host/experiment/repetitions.h"

#include <gtest/gtest.h>

namespace glintmark {
namespace {

using Clock = Repetitions::Clock;

// How many rounds of samples `of(round)` are made.
template <typename Sample>
std::size_t rounds(const Repetitions& reps, Sample of) {
  Samples samples;
  while (reps.wantsMore({&samples})) samples.push_back(of(samples.size()));
  return samples.size();
}

// 10 and 10.4 in turn: the standard error of the median is sqrt(pi / 2) 0.2 / sqrt(n), nearly.
double noisy(std::size_t round) {
  return round % 2 == 0 ? 10 : 10.4;
}

TEST(Repetitions, AreAsManyAsAsked) {
  EXPECT_EQ(rounds(5, noisy), 5u);
  EXPECT_EQ(rounds(Repetitions(9).atMost(4), noisy), 4u);
  EXPECT_EQ(rounds(Repetitions(5).scaled(0.5), noisy), 3u);
  EXPECT_EQ(rounds(Repetitions(5).scaled(2), noisy), 10u);
}

TEST(Repetitions, EndOnceTheMedianIsKnown) {
  const auto never = Clock::time_point::max();
  // 1.2533 0.2 / sqrt(n) <= 0.005 10.2 where n is 24.2 or more; stddev is a little above 0.2.
  const std::size_t made = rounds(Repetitions(3, 0.005, never), noisy);
  EXPECT_GE(made, 24u);
  EXPECT_LE(made, 27u);
  EXPECT_EQ(rounds(Repetitions(1, 0.5, never), noisy), 3u);  // fewer have no spread
  EXPECT_EQ(rounds(Repetitions(30, 0.5, never), noisy), 30u);
  EXPECT_EQ(rounds(Repetitions(3, 1e-9, never), noisy), 1000u);
  EXPECT_EQ(rounds(Repetitions(3, 1e-9, never).atMost(7), noisy), 7u);
}

TEST(Repetitions, OfSeveralSeriesEndWithTheNoisiest) {
  const Repetitions reps(3, 0.005, Clock::time_point::max());
  Samples quiet, loud;
  while (reps.wantsMore({&quiet, &loud})) {
    loud.push_back(noisy(loud.size()));
    quiet.push_back(1);
  }
  EXPECT_GE(loud.size(), 24u);
  std::vector<Samples> both(2);
  while (reps.wantsMore(both)) {
    both[0].push_back(1);
    both[1].push_back(noisy(both[1].size()));
  }
  EXPECT_EQ(both[1].size(), loud.size());
  EXPECT_FALSE(reps.wantsMore(std::vector<Samples>()));
}

TEST(Repetitions, StopWhenTimeIsOverButNotBeforeThereIsOne) {
  const auto over = Clock::now() - std::chrono::seconds(1);
  EXPECT_EQ(rounds(Repetitions(9, 0, over), noisy), 1u);
  EXPECT_EQ(rounds(Repetitions(9, 0.01, over), noisy), 1u);
}

}  // namespace
}  // namespace glintmark
