// Runs the kernels on hand-made pixels: any footprint, frame, view, material and lights.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "host/core/frame_packing.h"
#include "host/core/shared_types.h"
#include "host/frame/effect/scattering_params.h"
#include "host/harness/kernel_bench.h"
#include "host/ocl/kernel_config.h"
#include "host/reference/pixel.h"

namespace glintmark {

/// Widths that every property of the kernels is checked at.
inline constexpr int kAllWidths[] = {1, 4, 8, 16};

/// One entry of the planes.
struct HandMadePixel {
  reference::PixelFootprint footprint;
  PackedFrame frame;
  std::uint32_t x = 0, y = 0;             // screen position, which decides the view ray
  glm::dvec3 normal_dx{0}, normal_dy{0};  // change of the unit normal per pixel, world axes
};

/// Everything a shading launch reads.
struct HandMadeFrame {
  std::vector<HandMadePixel> pixels;
  glm::dvec3 ray_origin{0, 0, -1}, ray_dx{0}, ray_dy{0};  // away from the eye
  MaterialParams material{};
  std::vector<ConeLight> lights;
  /// Of kernels with multiple scattering or metal compensation.
  std::optional<MultiscatterMaterial> scatter{};
};

struct ShadedPixels {
  std::vector<glm::vec3> radiance;
  std::vector<std::uint32_t> cells;  // empty unless cells are counted
  std::vector<std::uint32_t> paid;   // cells that lanes worked through side by side
  std::vector<bool> limited;
};

/// Launches "shade" once. `config.planes` is filled in.
ShadedPixels shadePixels(KernelBench& bench, const HandMadeFrame& frame, KernelConfig config);

/// A material with one roughness per axis, white F0, no diffuse term, no colours.
MaterialParams simpleMaterial(float2 alpha_g, float2 alpha_l, float density,
                              float size_variation = 0);
ConeLight coneLight(const glm::dvec3& direction, double half_angle_rad = 0, double irradiance = 1);

/// u = coordinate split as the planes store it.
reference::FixedCoordinate fixedCoordinate(double coordinate);
/// Frame of the plane z = 0 with tangent +x.
PackedFrame flatFrame();

/// The reference's view of the same things.
reference::GlintRule referenceRule(GlintMethod method);
reference::Glints referenceGlints(const MaterialParams& material, bool groove = false);
reference::SurfacePixel referencePixel(const HandMadeFrame& frame, const HandMadePixel& pixel);
std::vector<reference::PointLight> referenceLights(const HandMadeFrame& frame);

}  // namespace glintmark
