// Separable filters of one-channel images; edges repeat the outermost pixels.
#pragma once
#include <functional>
#include <vector>

#include "host/core/image.h"

namespace glintmark {

/// 2 radius + 1 weights.
using FilterTaps = std::vector<float>;

/// exp(-x^2 / (2 sigma_px^2)) at whole pixels up to `radius_px`, of sum 1.
FilterTaps gaussianTaps(double sigma_px, int radius_px);

/// The image under `across` along x and `down` along y, each of an odd number of taps:
/// out(x) = sum of taps[i] in(x + i - radius), as a correlation.
Image filtered(const Image& plane, const FilterTaps& across, const FilterTaps& down);

/// Calls row(y) for all rows, on several threads.
void forEachRow(int height, const std::function<void(int y)>& row);

}  // namespace glintmark
