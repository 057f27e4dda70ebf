// Materials with multiple scattering made ready for the kernels.
#pragma once
#include "host/core/shared_types.h"
#include "host/fit/multiscatter_data.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/scene.h"

namespace glintmark {

#include "kernels/multiscatter.h"

static_assert(sizeof(MultiscatterMaterial) == 144);

/// The kernel's parameters of a material for one model and roughness; everything that depends on
/// the roughness alone is evaluated here. `mirror` may be null without metal compensation.
MultiscatterMaterial prepareMultiscatter(const GlintMaterial& material, Multiscatter model,
                                         double diffuse_roughness, const LobePolynomials& refit,
                                         const MirrorAlbedo* mirror);

/// The same for a material of a scene under its kernel's switches, with the project's fits.
MultiscatterMaterial prepareMultiscatter(const Material& material, const KernelConfig& config);

}  // namespace glintmark
