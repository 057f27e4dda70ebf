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

Image reduce(const Image& fine, int width, int height) {
  Image coarse(width, height, fine.channels);
  const auto stride = static_cast<std::size_t>(fine.channels);
  reduceTexels({fine.pixels.data(), fine.width, fine.height, stride},
               {coarse.pixels.data(), width, height, stride}, fine.channels);
  coarse.channel_names = fine.channel_names;
  return coarse;
}

// Each of twice as many texels both ways: as below with weights of 1, in the same order.
void halveTexels(const TexelGrid<const float>& fine, const TexelGrid<float>& coarse, int channels) {
  tbb::parallel_for(0, coarse.height, [&](int y) {
    const std::size_t row = static_cast<std::size_t>(fine.width) * fine.stride;
    const float* upper = fine.at(0, 2 * y);
    float* to = coarse.at(0, y);
    for (int x = 0; x < coarse.width; ++x, upper += 2 * fine.stride, to += coarse.stride) {
      const float *right = upper + fine.stride, *lower = upper + row, *last = right + row;
      for (int c = 0; c < channels; ++c) {
        const double sum = static_cast<double>(upper[c]) + right[c] + lower[c] + last[c];
        to[c] = static_cast<float>(sum * 0.25);
      }
    }
  });
}

}  // namespace

void reduceTexels(const TexelGrid<const float>& fine, const TexelGrid<float>& coarse,
                  int channels) {
  if (fine.width == 2 * coarse.width && fine.height == 2 * coarse.height) {
    halveTexels(fine, coarse, channels);
    return;
  }
  const std::vector<MipCover> columns = covers(coarse.width, fine.width);
  const std::vector<MipCover> rows = covers(coarse.height, fine.height);
  const double area = static_cast<double>(fine.width) / coarse.width *
                      (static_cast<double>(fine.height) / coarse.height);
  tbb::parallel_for(0, coarse.height, [&](int y) {
    std::vector<double> sum(static_cast<std::size_t>(channels));
    for (int x = 0; x < coarse.width; ++x) {
      std::ranges::fill(sum, 0.0);
      const MipCover &column = columns[x], &row = rows[y];
      for (std::size_t j = 0; j < row.weights.size(); ++j) {
        for (std::size_t i = 0; i < column.weights.size(); ++i) {
          const double weight = static_cast<double>(column.weights[i]) * row.weights[j];
          const float* const texel =
              fine.at(column.first + static_cast<int>(i), row.first + static_cast<int>(j));
          for (int c = 0; c < channels; ++c) sum[c] += weight * texel[c];
        }
      }
      for (int c = 0; c < channels; ++c) coarse.at(x, y)[c] = static_cast<float>(sum[c] / area);
    }
  });
}

bool levelsNest(int top, int below, int level) {
  return (below == 1 || below == 2 * level) && top % below == 0;
}

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
  MipChain chain;
  chain.levels.push_back(std::move(finest));
  for (int level = 1; level < count; ++level) {
    const Image& top = chain.levels.front();
    const int width = std::max(1, top.width >> level), height = std::max(1, top.height >> level);
    const Image& below = chain.levels.back();
    const bool nests =
        levelsNest(top.width, below.width, width) && levelsNest(top.height, below.height, height);
    Image next = reduce(nests ? below : top, width, height);
    chain.levels.push_back(std::move(next));
  }
  return chain;
}

}  // namespace glintmark
