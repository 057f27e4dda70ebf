// What is seen where no mesh is: the scene's environment.
#pragma once
#include "host/core/image.h"
#include "host/scene/scene.h"

namespace glintmark {

/// Adds the environment's radiance behind `picture` (RGBA, linear, at the view's size) where its
/// alpha leaves room, and makes it opaque there. Without an environment it changes nothing.
void placeBackground(Image& picture, const Scene& scene, const View& view);

}  // namespace glintmark
