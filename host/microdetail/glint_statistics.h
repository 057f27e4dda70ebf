// What the pixels of a lattice have in common: how bright, how dark, how they follow each other.
#pragma once
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace glintmark {

/// Of pixels' ratios to the smooth lobe.
struct GlintStatistics {
  double mean = 0, variance = 0;
  double dark = 0;     // share of pixels below kDarkRatio
  double largest = 0;  // ratio
  double correlation =
      0;              // of a pixel with its right and its lower neighbour; 0 where nothing varies
  double change = 0;  // mean absolute change when the view moves by a quarter of a pixel
};

/// A pixel is dark if it shows less than a hundredth of the smooth lobe.
inline constexpr double kDarkRatio = 0.01;
/// Pixels that the view moves by for GlintStatistics::change.
inline constexpr double kGlintMotion_px = 0.25;
/// How many times as long and wide pixels become by one small step of a zoom, 2^(1/16).
inline constexpr double kGlintZoomRatio = 1.0442737824274138;

/// `ratios` row after row, `columns` >= 1 a row; `moved` are the same pixels a little further on,
/// empty if nothing moved. Throws Error for no pixels or sizes that do not fit.
GlintStatistics glintStatistics(std::span<const float> ratios, int columns,
                                std::span<const float> moved = {});

/// Mean absolute change from `before` to `after`, of as many pixels, at least one. Throws Error
/// otherwise.
double meanChange(std::span<const float> before, std::span<const float> after);
/// Their correlation, about the mean of each; 0 where one does not vary.
double correlationOf(std::span<const float> a, std::span<const float> b);

/// The red channel.
std::vector<float> redOf(std::span<const glm::vec3> ratios);

}  // namespace glintmark
