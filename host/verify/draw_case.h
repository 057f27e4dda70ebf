// Pixels whose cells and draws are checked.
#pragma once
#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"
#include "host/verify/check.h"

namespace glintmark {

/// A material, a method and the footprints that pixels have.
struct DrawCase {
  const char* name;
  GlintMethod method;
  float2 alpha_g, alpha_l;
  float density;
  float size_variation;
  bool groove;
  int ka;
  FootprintRange footprints;
};

inline constexpr FootprintRange kUsual{1e-4, 1e-2, 20};
/// 2^40 cells along an axis. 32 bits are enough for 2048 uv.
inline constexpr FootprintRange kDeep{0x1p-21, 0x1p-17, 20, 1e6};

/// Does it reach beyond what 32 bits hold?
bool isDeep(const DrawCase& c);

/// Random pixels under one light.
HandMadeFrame drawFrame(const DrawCase& c);

/// Its pixels, with their cells counted.
ShadedPixels drawPixels(const CheckContext& context, const DrawCase& c, const HandMadeFrame& frame);

}  // namespace glintmark
