#include "host/report/difference/plane_filter.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace glintmark {
namespace {

Image filteredAcross(const Image& plane, const FilterTaps& taps) {
  const int radius = static_cast<int>(taps.size()) / 2;
  Image out(plane.width, plane.height, 1);
  forEachRow(plane.height, [&](int y) {
    const float* in = plane.at(0, y).data();
    std::vector<float> padded(static_cast<std::size_t>(plane.width + 2 * radius));
    for (int x = 0; x < static_cast<int>(padded.size()); ++x)
      padded[static_cast<std::size_t>(x)] = in[std::clamp(x - radius, 0, plane.width - 1)];
    float* row = out.at(0, y).data();
    for (std::size_t i = 0; i < taps.size(); ++i)
      for (int x = 0; x < plane.width; ++x)
        row[x] += taps[i] * padded[i + static_cast<std::size_t>(x)];
  });
  return out;
}

Image filteredDown(const Image& plane, const FilterTaps& taps) {
  const int radius = static_cast<int>(taps.size()) / 2;
  Image out(plane.width, plane.height, 1);
  forEachRow(plane.height, [&](int y) {
    float* row = out.at(0, y).data();
    for (int i = 0; i < static_cast<int>(taps.size()); ++i) {
      const float* in = plane.at(0, std::clamp(y + i - radius, 0, plane.height - 1)).data();
      const float weight = taps[static_cast<std::size_t>(i)];
      for (int x = 0; x < plane.width; ++x) row[x] += weight * in[x];
    }
  });
  return out;
}

}  // namespace

FilterTaps gaussianTaps(double sigma_px, int radius_px) {
  std::vector<double> weights;
  for (int x = -radius_px; x <= radius_px; ++x)
    weights.push_back(std::exp(-0.5 * x * x / (sigma_px * sigma_px)));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  FilterTaps taps;
  for (const double weight : weights) taps.push_back(static_cast<float>(weight / sum));
  return taps;
}

Image filtered(const Image& plane, const FilterTaps& across, const FilterTaps& down) {
  return filteredDown(filteredAcross(plane, across), down);
}

void forEachRow(int height, const std::function<void(int y)>& row) {
  tbb::parallel_for(0, height, row);
}

}  // namespace glintmark
