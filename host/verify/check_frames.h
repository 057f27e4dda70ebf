// Frames of small scenes, for checks.
#pragma once
#include <memory>

#include "host/core/image.h"
#include "host/frame/frame_renderer.h"
#include "host/verify/check.h"

namespace glintmark {

/// The radiance of one frame, as FrameRenderer::readRadiance.
Image checkFrame(const CheckContext& context, const Scene& scene, const View& view,
                 const ShadingOptions& options, std::shared_ptr<NormalTextures> textures = nullptr);

/// The mean over a frame of glints against that of the smooth lobe, which have to differ by more
/// than `least_difference` of it, pixel by pixel. The bound is kEnergyTolerance.
Finding frameEnergy(const CheckContext& context, const Scene& scene, const View& view,
                    double least_difference);

}  // namespace glintmark
