// What a user can choose about how a frame is shaded.
#pragma once
#include <memory>
#include <string>

#include "host/mixture/normal_mixture.h"
#include "host/ocl/kernel_config.h"

namespace glintmark {

struct LtcTable;

/// How a frame's materials become programs. The first is how scenes are shaded; the others are what
/// it is compared with.
enum class Programs {
  kPerMaterial,  // one specialised program for each material, over its pixel list
  kOneForAll,    // one program with every effect compiled in, over the same lists
  kFullScreen,   // the same over all pixels in the order of the screen
};

/// What a user can choose about shading; the scene decides the rest. Defaults: docs/accuracy.md.
struct ShadingOptions {
  int width_px = 1920;
  int height_px = 1080;
  int lanes = 0;  // 0: from the device
  GlintMethod method = GlintMethod::kZk16;
  int ka = 16;
  int grids = 2;  // of cells, blended per pixel: 1 or 2
  BinomialForm binomial = BinomialForm::kOfMethod;
  int binomial_terms = 16;  // of BinomialForm::kCapped, 2 to 64
  Maths maths = Maths::kOwn;
  bool glints = true;  // false: every glint material is shaded as its smooth lobe (the baseline)
  bool count_cells = false;
  NormalMethod normal_method = NormalMethod::kGmm;  // of materials with a normal map
  int lobes = 0;             // Gaussians of a mixture, 1 to 8; 0: the material's
  int anisotropy = 16;       // most texture probes along a footprint, 1 to 16
  bool half_texels = false;  // mixtures in half precision
  MixtureOrder mixture_order = MixtureOrder::kColours;
  int mixture_iterations = 0;                // EM steps of a texel in the fit; 0: the fit's default
  LtcMethod ltc_method = LtcMethod::kExact;  // of materials with a normal map under area lights
  bool clipless = false;                     // area lights are not clipped to the horizon
  Programs programs = Programs::kPerMaterial;
  EdgeIntegral edges = EdgeIntegral::kFit;      // over the edges of area lights
  bool ltc_half = false;                        // table of cosines in half precision
  std::shared_ptr<const LtcTable> ltc_table{};  // in place of the shipped table of its NDF
  bool truth = false;  // supersample instead of shading: addTruthSamples() in place of shade()
};

/// "zk16" or "exact"; throws Error listing the two.
GlintMethod parseMethod(const std::string& name);
std::string methodName(GlintMethod method);

}  // namespace glintmark
