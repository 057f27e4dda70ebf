#include "host/report/picture/tonemap.h"

#include <algorithm>
#include <cmath>

#include "host/core/error.h"

namespace glintmark {
namespace {

float displayValue(float radiance, const ToneMapOptions& options) {
  const double x = options.exposure * radiance;
  if (!(x > 0)) return 0.0f;  // also NaN
  if (x >= options.white) return 1.0f;
  const double compressed = x * (1 + x / (options.white * options.white)) / (1 + x);
  return encodeSrgb(static_cast<float>(compressed));
}

}  // namespace

float encodeSrgb(float x) {
  return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

float decodeSrgb(float x) {
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

Image toneMap(const Image& radiance, const ToneMapOptions& options) {
  if (radiance.channels != 1 && radiance.channels < 3) {
    throw Error("tone mapping needs an image of one channel or of red, green and blue");
  }
  Image display(radiance.width, radiance.height, 3);
  const int channel_step = radiance.channels == 1 ? 0 : 1;
  for (int y = 0; y < radiance.height; ++y) {
    for (int x = 0; x < radiance.width; ++x) {
      const auto in = radiance.at(x, y);
      const auto out = display.at(x, y);
      for (int c = 0; c < 3; ++c) out[c] = displayValue(in[c * channel_step], options);
    }
  }
  return display;
}

}  // namespace glintmark
