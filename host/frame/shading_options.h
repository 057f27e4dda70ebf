// What a user can choose about how a frame is shaded.
#pragma once
#include <memory>
#include <string>
#include <string_view>

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
// The knobs of the kernels: `method`, `ka`, `normal_method`, ..., each with its default.
#define KNOB_ELSE(macro, type, member, standard, ...) type member = standard;
#include "host/ocl/switches.inc"
  bool glints = true;  // false: every glint material is shaded as its smooth lobe (the baseline)
  bool count_cells = false;
  bool may_show_nothing = false;  // else a view that covers no pixel is refused
  int lobes = 0;                  // Gaussians of a mixture, 1 to 8; 0: the material's
  MixtureOrder mixture_order = MixtureOrder::kColours;
  int mixture_iterations = 0;  // EM steps of a texel in the fit; 0: the fit's default
  Programs programs = Programs::kPerMaterial;
  std::shared_ptr<const LtcTable> ltc_table{};  // in place of the shipped table of its NDF
};

/// Hands the knobs of an effect, a flag like &KernelConfig::glint or kEveryProgram, to a program
/// that has it. A program without the effect is left alone, and so stays what it was.
void setKnobs(const ShadingOptions& options, bool KernelConfig::*effect, KernelConfig& config);

/// Turns the knob of a switch, "KA" say. Throws Error if no knob is called so, or for a value that
/// it may not have.
void turnKnob(ShadingOptions& options, std::string_view macro, int value);

/// `count` if DRAWN_LIGHTS may be it; throws Error saying what it may be.
int checkedDrawnLights(int count);

/// "zk16", say; throws Error listing all.
GlintMethod parseMethod(const std::string& name);
/// The paper's by default, and what a help text says of all: "zk16 or exact (default: zk16)".
std::string defaultMethod();
std::string methodHelp(const std::string& by_default = defaultMethod());

}  // namespace glintmark
