// Views moved by parts of a pixel, so that pixels and texels are not in step.
#pragma once
#include "host/scene/scene.h"

namespace glintmark {

/// Right and up [px]. Errors of maps are means over views so shifted: however pixels and texels
/// lie, some of them lie otherwise.
inline constexpr double kShifts_px[][2] = {{0, 0}, {0.5, 0.25}, {0.25, 0.75}, {0.75, 0.5}};

/// `view` with eye and target moved across by so many pixels of a picture `height_px` high, as they
/// are at the target's distance.
View shiftedView(const View& view, double right_px, double up_px, int height_px);

}  // namespace glintmark
