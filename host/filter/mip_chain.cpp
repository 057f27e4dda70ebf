#include "host/filter/mip_chain.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "host/core/error.h"

namespace glintmark {
namespace {

std::vector<MipCover> covers(int coarse, int fine) {
  std::vector<MipCover> all;
  all.reserve(static_cast<std::size_t>(coarse));
  for (int x = 0; x < coarse; ++x) all.push_back(mipCover(x, coarse, fine));
  return all;
}

// Area-weighted means of `fine` on a grid of width x height.
Image reduce(const Image& fine, int width, int height) {
  Image coarse(width, height, fine.channels);
  const std::vector<MipCover> columns = covers(width, fine.width);
  const std::vector<MipCover> rows = covers(height, fine.height);
  const double area =
      static_cast<double>(fine.width) / width * (static_cast<double>(fine.height) / height);
  tbb::parallel_for(0, height, [&](int y) {
    std::vector<double> sum(static_cast<std::size_t>(fine.channels));
    for (int x = 0; x < width; ++x) {
      std::ranges::fill(sum, 0.0);
      const MipCover &column = columns[x], &row = rows[y];
      for (std::size_t j = 0; j < row.weights.size(); ++j) {
        for (std::size_t i = 0; i < column.weights.size(); ++i) {
          const double weight = static_cast<double>(column.weights[i]) * row.weights[j];
          const auto texel =
              fine.at(column.first + static_cast<int>(i), row.first + static_cast<int>(j));
          for (int c = 0; c < fine.channels; ++c) sum[c] += weight * texel[c];
        }
      }
      for (int c = 0; c < fine.channels; ++c) {
        coarse.at(x, y)[c] = static_cast<float>(sum[c] / area);
      }
    }
  });
  coarse.channel_names = fine.channel_names;
  return coarse;
}

}  // namespace

int mipLevelCount(int width_px, int height_px) {
  return std::bit_width(static_cast<unsigned>(std::max(width_px, height_px)));
}

MipCover mipCover(int x, int coarse, int fine) {
  // In units of 1/coarse of a fine texel, texel x covers [x, x + 1) * fine and fine texel i covers
  // [i, i + 1) * coarse: whole numbers, so that shares add up exactly.
  const std::int64_t begin = static_cast<std::int64_t>(x) * fine, end = begin + fine;
  const std::int64_t first = begin / coarse, last = (end + coarse - 1) / coarse;
  MipCover cover{static_cast<int>(first), {}};
  for (std::int64_t i = first; i < last; ++i) {
    const std::int64_t shared = std::min(end, (i + 1) * coarse) - std::max(begin, i * coarse);
    cover.weights.push_back(static_cast<float>(shared) / static_cast<float>(coarse));
  }
  return cover;
}

MipChain makeMipChain(Image finest) {
  if (finest.width < 1 || finest.height < 1 || finest.channels < 1) {
    throw Error("a mip chain needs an image of at least one texel");
  }
  const int count = mipLevelCount(finest.width, finest.height);
  const auto halves = [](int coarse, int fine) { return fine == 1 || fine == 2 * coarse; };
  MipChain chain;
  chain.levels.push_back(std::move(finest));
  for (int level = 1; level < count; ++level) {
    const Image& top = chain.levels.front();
    const int width = std::max(1, top.width >> level), height = std::max(1, top.height >> level);
    // From the level below where its texels nest, which is the same mean at a fraction of the work.
    const Image& below = chain.levels.back();
    const bool nests = halves(width, below.width) && halves(height, below.height) &&
                       top.width % below.width == 0 && top.height % below.height == 0;
    Image next = reduce(nests ? below : top, width, height);
    chain.levels.push_back(std::move(next));
  }
  return chain;
}

}  // namespace glintmark
