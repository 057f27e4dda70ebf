// Vectors of the host's as the device has them.
#pragma once
#include <glm/glm.hpp>

#include "host/core/shared_types.h"

namespace glintmark {

/// Rounded to float; `w` is the fourth component.
inline float4 toFloat4(const glm::dvec3& v, double w = 0) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z),
          static_cast<float>(w)};
}

}  // namespace glintmark
