// Every compile-time switch of the kernels in one plain struct.
#pragma once
#include <compare>
#include <string>

#include "host/core/planes.h"

namespace glintmark {

enum class GlintMethod : int {
  kZk16 = 0,   // the paper's text: at most ka steps along the footprint, two grids
  kExact = 1,  // uncapped, true parallelogram coverage, exact binomial quantile
};

/// How many microdetails of a cell reflect. kernels/config.clh explains.
enum class BinomialForm : int { kOfMethod, kExpected, kGaussian, kCapped, kExact };

/// Whose reciprocals, roots, powers and logarithms the kernels use.
enum class Maths : int { kOwn, kNative, kPrecise };

/// The integral over the edges of area lights.
enum class EdgeIntegral : int { kFit, kAcos, kRational };

/// How the normals under a pixel become one shading normal or lobe. kernels/config.clh explains.
enum class NormalMethod : int { kMip, kFixed, kToksvig, kLean, kFournier, kGmm };

/// How area lights see the normals' variation below a pixel. [TAO21] Sect. 3
enum class LtcMethod : int { kOriginal, kTao21, kExact };

/// Model of light scattered more than once among the facets of a diffuse surface.
enum class Multiscatter : int { kOff, kPublished, kRefit, kEon };

/// Keys the program cache (memory and disk) and is stored with every record. The meaning and range
/// of each switch stand in kernels/config.clh.
struct KernelConfig {
  int width = 1;               // lanes W: 1, 4, 8 or 16
  bool all_materials = false;  // one program that branches on each pixel's material
  bool glint = true;
  bool groove = false;
  bool glint_colour = false;
  bool size_variation = true;
  bool cone_lights = true;  // the scene has cone lights
  bool light_cone = false;  // some light is wider than a point
  bool diffuse = false;
  bool count_cells = false;
  GlintMethod method = GlintMethod::kZk16;
  int grids = 2;  // blended per pixel, 1 or 2
  BinomialForm binomial = BinomialForm::kOfMethod;
  int binomial_terms = 16;  // of BinomialForm::kCapped, 2..64
  Maths maths = Maths::kOwn;
  int ka = 16;       // K_a, steps along the footprint per grid, 1..64
  bool ggx = false;  // NDF of the smooth lobe: GGX, not Beckmann
  bool normal_map = false;
  NormalMethod normal_method = NormalMethod::kMip;
  int lobes = 1;             // of a Gaussian mixture, 1..8
  int anisotropy = 1;        // most probes along a footprint, 1..16
  bool half_texels = false;  // half-precision layout of a mixture
  bool ltc = false;          // the scene has area lights
  LtcMethod ltc_method = LtcMethod::kOriginal;
  int light_vertices = 4;  // of the area light that has most, 3..8
  bool clipless = false;   // area lights are not clipped to the horizon
  EdgeIntegral edges = EdgeIntegral::kFit;
  bool ltc_half = false;       // table of cosines in half precision
  bool light_texture = false;  // some area light is textured
  Multiscatter multiscatter = Multiscatter::kOff;
  bool lobe_masking = false;        // masking and shadowing of multiple scattering
  bool metal_compensation = false;  // specular albedo scaling for light scattered more than once
  PlaneMask planes;                 // planes in the buffer; each becomes PLANE_<NAME> = its slot

  bool operator==(const KernelConfig&) const = default;
};

/// The only place that writes -D: options for clBuildProgram, e.g. "-D WIDTH=16 -D GLINT=1 ...".
std::string buildOptions(const KernelConfig& config);

}  // namespace glintmark
