// Which effects, and so which planes, a scene calls for. Nobody lists them by hand.
#pragma once
#include "host/core/planes.h"
#include "host/frame/frame_renderer.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/scene.h"

namespace glintmark {

/// Planes that the kernel of this configuration reads.
PlaneMask planesFor(const KernelConfig& config);

/// Switches of one material's kernel under the scene's lights. `lanes` is W. The plane mask is left
/// at what this material alone reads; a frame stores the union over its materials.
KernelConfig configFor(const Material& material, const Scene& scene, const ShadingOptions& options,
                       int lanes);

/// Planes that any material of the scene reads.
PlaneMask planesFor(const Scene& scene, const ShadingOptions& options);

}  // namespace glintmark
