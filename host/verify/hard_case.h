// Pixels at their limits: nothing may be NaN, infinite or negative, and where the reference has an
// answer the kernel has the same.
#pragma once
#include <cstddef>
#include <span>

#include "host/harness/pixel_harness.h"
#include "host/verify/check.h"

namespace glintmark {

/// One case in the making. Errors are shares of pixels.
struct HardCase {
  const CheckContext& context;
  GlintMethod method;
  Finding finding;

  /// Of the method, counting cells.
  KernelConfig config() const;

  /// Shades, and requires that every value is a radiance.
  ShadedPixels shadeSanely(const HandMadeFrame& frame, const KernelConfig& c);
  ShadedPixels shadeSanely(const HandMadeFrame& frame) { return shadeSanely(frame, config()); }

  /// The same, and compares with the reference: counts, and radiance but for the lobe's fit.
  void expectReference(const HandMadeFrame& frame);

  /// Requires that every pixel is `wanted`.
  void expectRadiance(const ShadedPixels& shaded, double wanted);
};

/// `count` pixels of one flat surface, view and light, none of them hard.
HandMadeFrame plainFrame(std::size_t count = 1);

struct NamedHardCase {
  const char* name;
  void (*run)(HardCase&);
  double flipped_share;  // of pixels that may differ from the reference: many cells, many draws
};

std::span<const NamedHardCase> hardFootprints();
std::span<const NamedHardCase> hardSurfaces();

}  // namespace glintmark
