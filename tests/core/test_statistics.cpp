#include <gtest/gtest.h>

#include <vector>

#include "host/core/error.h"
#include "host/core/statistics.h"

namespace glintmark {
namespace {

TEST(Statistics, KnownSample) {
  const std::vector<double> samples = {4, 1, 3, 2, 5};
  const Summary s = summarize(samples);
  EXPECT_EQ(s.n, 5u);
  EXPECT_DOUBLE_EQ(s.min, 1);
  EXPECT_DOUBLE_EQ(s.median, 3);
  EXPECT_DOUBLE_EQ(s.p95, 4.8);
  EXPECT_NEAR(s.stddev, 1.5811388300841898, 1e-15);
}

TEST(Statistics, OneSampleHasNoSpread) {
  const std::vector<double> samples = {7};
  EXPECT_DOUBLE_EQ(summarize(samples).p95, 7);
  EXPECT_DOUBLE_EQ(summarize(samples).stddev, 0);
}

TEST(Statistics, EmptyIsAnError) {
  EXPECT_THROW(summarize({}), Error);
}

}  // namespace
}  // namespace glintmark
