// Cameras for a mesh that the scene file does not know.
#pragma once
#include <vector>

#include "host/scene/scene.h"

namespace glintmark {

/// Turns every view into an orbit around the middle of the mesh, far enough to see all of it, over
/// the side that it shows most (of +x, -x, +y ...): at 10 degrees to that side if the view's name
/// is `grazing`, else perpendicular to it.
void fitViews(const TriangleMesh& mesh, std::vector<View>& views);

}  // namespace glintmark
