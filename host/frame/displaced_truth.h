// Ground truth of a flat mesh whose normal map is the relief that it comes from: the heights stand
// up from the mesh, and hide and shade each other. On the host, in double precision, ray by ray.
#pragma once
#include <functional>

#include "host/core/image.h"
#include "host/scene/scene.h"

namespace glintmark {

struct DisplacedTruthOptions {
  int width_px = 0, height_px = 0;
  int spp = 64;             // samples a pixel, 1 to 2^20
  double height_scale = 1;  // of all heights; 0 is the flat mesh with its normal map
};

/// RGBA as FrameRenderer::readRadiance() gives it. A sample is the first point of the relief on its
/// ray, bilinear between texels, and is shaded under each light that it sees like a smooth surface
/// whose normal is the map's, interpolated as in kernels/truth.cl. A pixel is the mean over those
/// of its samples that meet the mesh's part of the relief; it is covered if the mesh itself covers
/// its centre.
/// Throws Error unless the scene is one flat rectangle with one smooth Lambertian material, a map
/// made of heights, and lights that are points. `progress` gets the rows that are done.
Image renderDisplacedTruth(const Scene& scene, const View& view,
                           const DisplacedTruthOptions& options,
                           const std::function<void(int rows)>& progress = {});

}  // namespace glintmark
