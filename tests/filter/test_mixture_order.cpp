// Orders of the fit: who may see whom.
#include <gtest/gtest.h>

#include <map>

#include "host/core/error.h"
#include "host/mixture/mixture_order.h"

namespace glintmark {
namespace {

constexpr MixtureOrder kOrders[] = {MixtureOrder::kColours, MixtureOrder::kScanline,
                                    MixtureOrder::kIndependent};

// The batch of every texel; fails where a texel is in none or in two.
std::map<std::pair<int, int>, int> batchNumbers(MixtureOrder order, int width, int height) {
  std::map<std::pair<int, int>, int> numbers;
  int number = 0;
  for (const TexelBatch& batch : texelBatches(order, width, height)) {
    for (int i = 0; i < batch.count; ++i) {
      const glm::ivec2 t = batch.at(i);
      EXPECT_TRUE(t.x >= 0 && t.y >= 0 && t.x < width && t.y < height);
      EXPECT_TRUE(numbers.emplace(std::pair{t.x, t.y}, number).second);
    }
    ++number;
  }
  EXPECT_EQ(numbers.size(), static_cast<std::size_t>(width) * height);
  return numbers;
}

TEST(MixtureOrder, TexelsSeeOnlyWhatNoOtherThreadIsWriting) {
  for (const MixtureOrder order : kOrders) {
    for (const auto& [width, height] : {std::pair{8, 8}, {7, 5}, {1, 9}, {9, 1}, {1, 1}, {2, 3}}) {
      const auto numbers = batchNumbers(order, width, height);
      for (const auto& [texel, own] : numbers) {
        const glm::ivec2 at(texel.first, texel.second);
        const Neighbours first = visibleNeighbours(order, true, at, width, height);
        for (int k = 0; k < first.count; ++k) {
          EXPECT_LT(numbers.at({first.texels[k].x, first.texels[k].y}), own);
        }
        const Neighbours later = visibleNeighbours(order, false, at, width, height);
        for (int k = 0; k < later.count; ++k) {
          EXPECT_NE(numbers.at({later.texels[k].x, later.texels[k].y}), own);
        }
      }
    }
  }
}

// The serial order of [TAN05] Sect. 4.1: row by row, every texel already fitted is a neighbour, in
// its last state. Diagonals give the same if the texels seen are fitted before and those fitted
// later, which a second sweep sees in their old state, come after.
TEST(MixtureOrder, DiagonalsAreTheSerialScanline) {
  const int width = 9, height = 6;
  const auto numbers = batchNumbers(MixtureOrder::kScanline, width, height);
  for (const auto& [texel, own] : numbers) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const auto other = numbers.find({texel.first + dx, texel.second + dy});
        if (other == numbers.end() || other->first == texel) continue;
        const bool earlier = dy < 0 || (dy == 0 && dx < 0);
        EXPECT_EQ(other->second < own, earlier);
      }
    }
  }
  const auto count = [&](int x, int y) {
    return visibleNeighbours(MixtureOrder::kScanline, true, {x, y}, width, height).count;
  };
  EXPECT_EQ(count(0, 0), 0);
  EXPECT_EQ(count(4, 0), 1);
  EXPECT_EQ(count(4, 3), 4);
}

TEST(MixtureOrder, NamesGoBothWays) {
  for (const MixtureOrder order : kOrders) {
    EXPECT_EQ(parseMixtureOrder(mixtureOrderName(order)), order);
  }
  EXPECT_THROW(parseMixtureOrder("random"), Error);
}

}  // namespace
}  // namespace glintmark
