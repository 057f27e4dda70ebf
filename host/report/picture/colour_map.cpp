#include "host/report/picture/colour_map.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/report/picture/tonemap.h"

namespace glintmark {
namespace {

constexpr int kEntries = 256;
constexpr double kDarkest = 0.25, kLightest = 0.95;
constexpr double kFirstHueDeg = 300, kLastHueDeg = 100;
constexpr double kMaxChroma = 0.17;

using LinearColour = std::array<double, 3>;

// OKLab to linear sRGB: B. Ottosson, "A perceptual color space for image processing", 2020.
LinearColour fromOklch(double lightness, double chroma, double hue_rad) {
  const double a = chroma * std::cos(hue_rad), b = chroma * std::sin(hue_rad);
  const double l = std::pow(lightness + 0.3963377774 * a + 0.2158037573 * b, 3);
  const double m = std::pow(lightness - 0.1055613458 * a - 0.0638541728 * b, 3);
  const double s = std::pow(lightness - 0.0894841775 * a - 1.2914855480 * b, 3);
  return {4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
          -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
          -0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s};
}

bool inGamut(const LinearColour& colour) {
  return std::ranges::all_of(colour, [](double c) { return c >= 0 && c <= 1; });
}

DisplayColour makeEntry(double t) {
  const double lightness = std::lerp(kDarkest, kLightest, t);
  const double hue = std::lerp(kFirstHueDeg, kLastHueDeg, t) * std::numbers::pi / 180;
  double chroma = kMaxChroma;
  if (!inGamut(fromOklch(lightness, chroma, hue))) {
    // The gamut is star-shaped around grey, so bisection finds its edge.
    double inside = 0, outside = kMaxChroma;
    for (int i = 0; i < 30; ++i) {
      chroma = 0.5 * (inside + outside);
      (inGamut(fromOklch(lightness, chroma, hue)) ? inside : outside) = chroma;
    }
    chroma = inside;
  }
  const LinearColour linear = fromOklch(lightness, chroma, hue);
  DisplayColour display;
  for (int c = 0; c < 3; ++c) display[c] = encodeSrgb(static_cast<float>(linear[c]));
  return display;
}

}  // namespace

DisplayColour falseColour(double t) {
  static const auto table = [] {
    std::array<DisplayColour, kEntries> entries;
    for (int i = 0; i < kEntries; ++i) entries[i] = makeEntry(i / (kEntries - 1.0));
    return entries;
  }();
  const double clamped = t > 0 ? std::min(t, 1.0) : 0;
  return table[static_cast<std::size_t>(std::lround(clamped * (kEntries - 1)))];
}

}  // namespace glintmark
