// What one effect is to the host: all that the program knows of it stands in one file of
// host/frame/effect, as one of these.
#pragma once
#include <span>

#include "host/core/planes.h"
#include "host/core/shared_types.h"
#include "host/frame/effect_set.h"
#include "host/frame/frame_resources.h"
#include "host/frame/shade_arguments.h"
#include "host/frame/shading_options.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/scene.h"

namespace glintmark {

/// What a program is made for: one material under the lights of its scene.
struct ProgramCall {
  const Material& material;
  const Scene& scene;
  const ShadingOptions& options;
  bool truth = false;  // the ground truth's program, kernels/truth.cl
};

/// Functions that an effect has no use for are null. Its name and its switch stand in its row of
/// host/ocl/switches.inc.
struct EffectModule {
  EffectSet needs{};  // effects without which this one does nothing

  /// Does one of a scene's materials call for it, or the scene itself? An effect with neither is
  /// called for where all that it needs is.
  bool (*material_calls)(const Material& material) = nullptr;
  bool (*scene_calls)(const Scene& scene) = nullptr;
  /// Takes it out of a material, a scene or options; smooth lobes and Lambert's stand in.
  void (*strip_material)(Material& material) = nullptr;
  void (*strip_scene)(Scene& scene) = nullptr;
  void (*strip_options)(ShadingOptions& options) = nullptr;

  /// Sets its switches in a program; those of effects before it are set.
  void (*choose)(const ProgramCall& call, KernelConfig& config) = nullptr;
  /// Does a program hold it? Only of an effect that has no switch of its own.
  bool (*is_in)(const KernelConfig& config) = nullptr;
  PlaneMask planes{};  // what a program with it reads

  /// May two materials' programs, as far as this effect goes, become one?
  bool (*agree)(const KernelConfig& a, const KernelConfig& b) = nullptr;
  /// Compiles it into a program for all materials, where its switch is on already; `own` holds the
  /// materials' own switches.
  void (*choose_for_all)(std::span<const KernelConfig> own, const ShadingOptions& options,
                         KernelConfig& all) = nullptr;

  /// Adds what its kernel functions read: of `material`, or of all if `config` is for all.
  void (*add_arguments)(FrameResources& frame, const Material& material, const KernelConfig& config,
                        ShadeArguments& arguments) = nullptr;
  /// Sets what it reads of the frame's parameters.
  void (*describe)(FrameResources& frame, const KernelConfig& config,
                   FrameParams& params) = nullptr;
};

/// By effect; and all, in the order of the enumeration.
const EffectModule& effectModule(Effect effect);
std::span<const EffectModule* const> effectModules();

/// Turns on its own switch, if it has one.
void turnOn(Effect effect, KernelConfig& config);

#define MODULE(enumerator, name) const EffectModule& name##Effect();
#include "host/ocl/switches.inc"

}  // namespace glintmark
