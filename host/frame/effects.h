// Which effects, and so which planes, a scene calls for. Nobody lists them by hand.
#pragma once
#include "host/core/planes.h"
#include "host/frame/shading_options.h"
#include "host/ocl/kernel_config.h"
#include "host/scene/scene.h"

namespace glintmark {

/// Planes that the kernel of this configuration reads.
PlaneMask planesFor(const KernelConfig& config);

/// Switches of one material's kernel under the scene's lights. `lanes` is W. The plane mask is left
/// at what this material alone reads; a frame stores the union over its materials.
KernelConfig configFor(const Material& material, const Scene& scene, const ShadingOptions& options,
                       int lanes);

/// The same for the program of the ground truth, kernels/truth.cl, which has no knobs.
KernelConfig truthConfigFor(const Material& material, const Scene& scene,
                            const ShadingOptions& options, int lanes);

/// The same for one program that holds every effect, whether the scene calls for it or not, and
/// branches on each pixel's material. What is a choice and no effect (light cones, methods, lobes,
/// the model of multiple scattering, the NDF) is the scene's. Throws Error if materials differ in
/// such a choice.
KernelConfig configForAll(const Scene& scene, const ShadingOptions& options, int lanes);

/// Planes that the programs of the frame read, and those of its ground truth.
PlaneMask planesFor(const Scene& scene, const ShadingOptions& options);
PlaneMask truthPlanesFor(const Scene& scene, const ShadingOptions& options);

}  // namespace glintmark
