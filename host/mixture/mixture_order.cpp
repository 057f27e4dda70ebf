#include "host/mixture/mixture_order.h"

#include <fmt/format.h>

#include <algorithm>

#include "host/core/error.h"

namespace glintmark {
namespace {

int colour(glm::ivec2 texel) {
  return (texel.x & 1) + 2 * (texel.y & 1);
}

bool sees(MixtureOrder order, bool first_sweep, glm::ivec2 texel, glm::ivec2 other) {
  if (order == MixtureOrder::kColours) {
    return first_sweep ? colour(other) < colour(texel) : colour(other) != colour(texel);
  }
  return !first_sweep || other.y < texel.y || (other.y == texel.y && other.x < texel.x);
}

}  // namespace

std::vector<TexelBatch> texelBatches(MixtureOrder order, int width, int height) {
  std::vector<TexelBatch> batches;
  if (order == MixtureOrder::kIndependent) {
    batches.push_back({width * height, {0, 0}, width, 1, {0, 1}});
  } else if (order == MixtureOrder::kColours) {
    for (int y = 0; y < std::min(2, height); ++y) {
      for (int x = 0; x < std::min(2, width); ++x) {
        const int columns = (width - x + 1) / 2, rows = (height - y + 1) / 2;
        batches.push_back({columns * rows, {x, y}, columns, 2, {0, 2}});
      }
    }
  } else {
    for (int diagonal = 0; diagonal <= width - 1 + 2 * (height - 1); ++diagonal) {
      const int first = std::max(0, (diagonal - (width - 1) + 1) / 2);
      const int last = std::min(height - 1, diagonal / 2);
      batches.push_back({last - first + 1, {diagonal - 2 * first, first}, 1, 0, {-2, 1}});
    }
  }
  std::erase_if(batches, [](const TexelBatch& batch) { return batch.count < 1; });
  return batches;
}

Neighbours visibleNeighbours(MixtureOrder order, bool first_sweep, glm::ivec2 texel, int width,
                             int height) {
  Neighbours result;
  if (order == MixtureOrder::kIndependent) return result;
  for (int dy = -1; dy <= 1; ++dy) {
    for (int dx = -1; dx <= 1; ++dx) {
      glm::ivec2 other = texel + glm::ivec2(dx, dy);
      if (order == MixtureOrder::kColours) {
        other.x = (other.x + width) % width, other.y = (other.y + height) % height;
      }
      const bool inside = other.x >= 0 && other.y >= 0 && other.x < width && other.y < height;
      if (inside && other != texel && sees(order, first_sweep, texel, other)) {
        result.texels[result.count++] = other;
      }
    }
  }
  return result;
}

MixtureOrder parseMixtureOrder(const std::string& name) {
  for (const MixtureOrder order :
       {MixtureOrder::kColours, MixtureOrder::kScanline, MixtureOrder::kIndependent}) {
    if (name == mixtureOrderName(order)) return order;
  }
  throw Error(
      fmt::format("unknown order '{}'; orders are colours, scanline and independent", name));
}

std::string mixtureOrderName(MixtureOrder order) {
  switch (order) {
    case MixtureOrder::kColours:
      return "colours";
    case MixtureOrder::kScanline:
      return "scanline";
    default:
      return "independent";
  }
}

}  // namespace glintmark
