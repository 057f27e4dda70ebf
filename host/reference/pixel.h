// One pixel of glints under point lights, in double precision: [ZK16] Listing 1 with the seeds of
// kernels/README.md.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "host/core/frame_packing.h"
#include "host/reference/footprint.h"
#include "host/reference/seeds.h"

namespace glintmark::reference {

/// [ZK16] Sect. 4.5, uncoloured.
struct Glints {
  glm::dvec2 alpha_g{0.3}, alpha_l{0.03};
  double density = 1e6;  // microdetails per unit uv area
  double size_variation = 0;
  double intensity = 1;
  glm::dvec3 f0{1.0};
  bool groove = false;
};

struct PointLight {
  glm::dvec3 direction{0, 0, 1};  // unit, world space, towards the light
  glm::dvec3 irradiance{1.0};     // on a surface that faces it
};

struct SurfacePixel {
  PixelFootprint footprint;
  ShadingFrame frame;
  glm::dvec3 view{0, 0, 1};  // unit, world space, towards the eye
};

/// How a pixel's cells are found and drawn: kernels/glint/method_*.clh.
enum class GlintRule {
  kZk16,
  kExact,
  kDistributed,
  kDeliotBelcour,
  kDeliotCorrected,
  kKemppinen,
  kPublishedZk16,
  kChermain,
  kChermainCorrected
};

struct GlintMethodOptions {
  GlintRule method = GlintRule::kZk16;
  int ka = 16;
  bool deep_uv = false;  // false: cells recur after 2^32 along an axis
};

struct PixelResult {
  glm::dvec3 radiance{0.0};
  glm::dvec3 smooth{0.0};   // what radiance averages to over many cells
  std::uint32_t cells = 0;  // visited, over all lights that reach the pixel
  bool limited = false;
  bool tied = false;  // see GridVisit
  /// What one microdetail more in the heaviest of the cells whose count is drawn from the normal
  /// distribution adds to radiance / smooth: there k rounds a real number.
  double rounding = 0;
};

/// Step 5 of "The draws": index of a half vector (unit, tangent frame).
HalfVectorIndex halfVectorIndex(const glm::dvec3& half, const Glints& glints);

PixelResult evaluatePixel(const SurfacePixel& pixel, const Glints& glints,
                          std::span<const PointLight> lights, const GlintMethodOptions& options);

}  // namespace glintmark::reference
