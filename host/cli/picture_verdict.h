// What is wrong with a rendered picture, for exit codes.
#pragma once
#include "host/core/image.h"
#include "host/scene/scene.h"

namespace glintmark {

enum class PictureFault {
  kNone,
  kNotFinite,  // some value is infinite or NaN
  kBlack,      // meshes are there, and no light of theirs
  kEmpty,      // no mesh covers a pixel
};

/// The gravest fault of radiance as FrameRenderer::readRadiance() gives it; says it on standard
/// error. A picture of the environment alone is not empty, which is said too.
PictureFault judgePicture(const Image& radiance, const Scene& scene, const View& view,
                          bool shows_environment);

}  // namespace glintmark
