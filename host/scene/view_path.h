// A view that moves.
#pragma once
#include <string>

#include "host/scene/scene.h"

namespace glintmark {

enum class ViewPath {
  kOrbit,  // the eye around the target
  kDolly,  // the eye towards the target
  kPan,    // the target around the eye
};

/// "orbit", "dolly" or "pan"; throws Error listing them.
ViewPath parseViewPath(const std::string& name);

/// The view `way` along the path: degrees around the view's up for kOrbit (the eye to its right)
/// and kPan (the view to its right), per cent of the distance for kDolly, below 100. Throws Error
/// for a dolly that reaches the target.
View viewOnPath(const View& view, ViewPath path, double way);

}  // namespace glintmark
