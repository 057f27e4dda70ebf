#include "host/verify/draw_case.h"

namespace glintmark {
namespace {

constexpr double kShallow_uv = 2048;

// Puts every fourth pixel next to where an index reaches a multiple of 2^31, whose cells stand on
// both sides; 1237 and 2011 are the offsets of uv.
void moveToBorders(std::vector<HandMadePixel>& pixels) {
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const int k = static_cast<int>(i / 4 % 128) - 64;
    const double within = 0x1p-20 * (static_cast<double>(i % 61) - 29.63);
    pixels[i].footprint.u = fixedCoordinate(kShallow_uv * k - 1237 + within);
    pixels[i].footprint.v = fixedCoordinate(kShallow_uv * (k / 2) - 2011 - within);
  }
}

}  // namespace

bool isDeep(const DrawCase& c) {
  return c.footprints.most_uv > kShallow_uv;
}

HandMadeFrame drawFrame(const DrawCase& c) {
  HandMadeFrame frame;
  frame.material = simpleMaterial(c.alpha_g, c.alpha_l, c.density, c.size_variation);
  frame.pixels = randomPixels(2000, c.footprints);
  if (isDeep(c)) moveToBorders(frame.pixels);
  frame.lights = {coneLight({-0.3, 0.2, 0.9})};
  setRandomRays(frame);
  return frame;
}

ShadedPixels drawPixels(const CheckContext& context, const DrawCase& c,
                        const HandMadeFrame& frame) {
  KernelConfig config;
  config.width = context.lanes;
  config.method = c.method;
  config.ka = c.ka;
  config.groove = c.groove;
  config.size_variation = c.size_variation > 0;
  config.deep_uv = isDeep(c);
  config.count_cells = true;
  return shadePixels(context.bench, frame, config);
}

}  // namespace glintmark
