// A plane of glints that fills the screen, all of whose pixels are alike: the pixels of
// accuracy/glint_axis.h, as a scene.
#pragma once
#include "host/core/image.h"
#include "host/experiment/accuracy/glint_axis.h"
#include "host/scene/scene.h"

namespace glintmark {

/// `lights` point lights, at most 3, each of which so many microdetails of a pixel reflect as
/// `stage` says; a pixel's footprint is as long as `stage` says. One view, "plane".
Scene glintPlane(const GlintStage& stage, int lights, int height_px);

}  // namespace glintmark
