// A caster of rays at a height field in double precision, slow and without maps.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "host/simulate/heightfield_types.h"

namespace glintmark {

/// Rays against the triangles of a surface, all in double precision, cell by cell from above the
/// highest vertex.
class ReferenceCaster {
 public:
  ReferenceCaster(std::vector<std::int32_t> counts, double count_height)
      : counts_(std::move(counts)), count_height_(count_height) {
    top_ = count_height_ * *std::ranges::max_element(counts_);
  }

  /// Mirror bounces of a ray until it leaves, at most `most` + 1.
  int bounces(glm::dvec3 at, glm::dvec3 direction, int most) const {
    int count = 0;
    glm::dvec3 normal;
    while (count <= most && next(at, direction, normal)) {
      direction -= 2 * glm::dot(direction, normal) * normal;
      ++count;
    }
    return count;
  }

  double top() const { return top_; }

 private:
  glm::dvec3 vertex(long x, long y) const {
    constexpr long kMask = static_cast<long>(HF_TILE) - 1;
    const auto i = static_cast<std::size_t>((y & kMask) * static_cast<long>(HF_TILE) + (x & kMask));
    return {x, y, count_height_ * counts_[i]};
  }

  // Moves `at` to the first triangle in the way that faces the ray; false when there is none.
  bool next(glm::dvec3& at, glm::dvec3 direction, glm::dvec3& normal) const {
    auto x = static_cast<long>(std::floor(at.x)), y = static_cast<long>(std::floor(at.y));
    const long step_x = direction.x > 0 ? 1 : -1, step_y = direction.y > 0 ? 1 : -1;
    for (double t = 0; direction.z < 0 || at.z + t * direction.z < top_;) {
      double nearest = 1e300;
      const glm::dvec3 a = vertex(x, y), b = vertex(x + 1, y), c = vertex(x + 1, y + 1),
                       d = vertex(x, y + 1);
      for (const auto& [p, q, r] : {std::array{a, b, c}, std::array{a, c, d}}) {
        const glm::dvec3 n = glm::cross(q - p, r - p);
        const double closing = glm::dot(direction, n);
        if (closing >= 0) continue;
        const double hit = glm::dot(p - at, n) / closing;
        const glm::dvec3 point = at + hit * direction;
        const auto inside = [&](const glm::dvec3& from, const glm::dvec3& to) {
          return (to.x - from.x) * (point.y - from.y) - (to.y - from.y) * (point.x - from.x) >
                 -1e-12;
        };
        if (hit > -1e-9 && hit < nearest && inside(p, q) && inside(q, r) && inside(r, p)) {
          nearest = hit;
          normal = glm::normalize(n);
        }
      }
      if (nearest < 1e300) {
        at += nearest * direction;
        return true;
      }
      const double to_x = (static_cast<double>(x + (step_x > 0)) - at.x) / direction.x;
      const double to_y = (static_cast<double>(y + (step_y > 0)) - at.y) / direction.y;
      t = std::min(to_x, to_y);
      (to_x < to_y ? x : y) += to_x < to_y ? step_x : step_y;
    }
    return false;
  }

  std::vector<std::int32_t> counts_;
  double count_height_, top_;
};

}  // namespace glintmark
