// One view seen nearer and nearer: what pops, pulses or flashes on the way shows side by side.
#pragma once
#include <functional>

#include "host/frame/frame_renderer.h"

namespace glintmark {

/// Most octaves of a strip: beyond, a pixel is narrower than cameras resolve.
inline constexpr int kMostZoomOctaves = 24;

/// Display pictures of the view through fields of view from its own down to 2^-octaves of it, each
/// by a factor of sqrt(2) narrower than the one before, in rows, each below its zoom. The eye stays
/// where it is, so that light and half vectors do too and pixels' footprints shrink. `octaves`: 1
/// to kMostZoomOctaves; Error else. `judge` gets each picture's radiance, and may throw.
Image zoomStrip(Device& device, const Scene& scene, const View& view, const ShadingOptions& shading,
                int octaves, double exposure, int thread_count,
                const std::function<void(const Image& radiance)>& judge);

}  // namespace glintmark
