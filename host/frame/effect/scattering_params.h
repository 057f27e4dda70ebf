// Materials with multiple scattering, or compensation, made ready for the kernels.
#pragma once
#include "host/fit/multiscatter_data.h"
#include "host/fit/multiscatter_types.h"
#include "host/frame/frame_resources.h"
#include "host/frame/shade_arguments.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/scene.h"

namespace glintmark {

/// The kernel's parameters of a material under its kernel's switches; everything that depends on
/// the roughness alone is evaluated here. `data` holds the fits: the project's own if null, which
/// are read only where the material needs them.
MultiscatterMaterial prepareMultiscatter(const Material& material, const KernelConfig& config,
                                         const MultiscatterData* data = nullptr);

/// Adds the argument `scatter` of a program with either effect: parameters of `material`, or of all
/// materials if `config` is for all.
void addScattering(FrameResources& frame, const Material& material, const KernelConfig& config,
                   ShadeArguments& arguments);

}  // namespace glintmark
