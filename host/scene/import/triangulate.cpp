#include "host/scene/import/triangulate.h"

#include <cmath>

namespace glintmark {
namespace {

// Ears are looked for among so many corners at most, since that takes the cube of their number in
// the worst case; larger dented polygons are cut as a fan.
constexpr std::size_t kMostEarCorners = 512;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
  return a.x * b.y - a.y * b.x;
}

/// The polygon along its mean normal, counter-clockwise.
std::vector<glm::dvec2> project(std::span<const glm::dvec3> corners) {
  glm::dvec3 normal(0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  int axis = 0;
  for (const int i : {1, 2})
    if (std::abs(normal[i]) > std::abs(normal[axis])) axis = i;
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  const double side = normal[axis] < 0 ? -1 : 1;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::dvec3& p : corners)
    flat.emplace_back(p[u] - corners[0][u], side * (p[v] - corners[0][v]));
  return flat;
}

bool isConvex(const std::vector<glm::dvec2>& flat) {
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 &a = flat[i], &b = flat[(i + 1) % n], &c = flat[(i + 2) % n];
    if (cross(b - a, c - b) < 0) return false;
  }
  return true;
}

bool isInside(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  if (p == a || p == b || p == c) return false;
  return cross(b - a, p - a) >= 0 && cross(c - b, p - b) >= 0 && cross(a - c, p - c) >= 0;
}

bool isEar(const std::vector<glm::dvec2>& flat, const std::vector<int>& left, std::size_t at) {
  const std::size_t n = left.size();
  const glm::dvec2 &a = flat[left[(at + n - 1) % n]], &b = flat[left[at]],
                   &c = flat[left[(at + 1) % n]];
  if (cross(b - a, c - b) <= 0) return false;
  for (const int i : left)
    if (isInside(flat[i], a, b, c)) return false;
  return true;
}

}  // namespace

void triangulate(std::span<const glm::dvec3> corners, std::vector<std::array<int, 3>>& out) {
  const int n = static_cast<int>(corners.size());
  if (n < 3) return;
  std::vector<int> left(corners.size());
  for (int i = 0; i < n; ++i) left[i] = i;
  if (n > 3 && corners.size() <= kMostEarCorners) {
    const std::vector<glm::dvec2> flat = project(corners);
    for (bool cut = !isConvex(flat); cut && left.size() > 3;) {
      cut = false;
      for (std::size_t i = 0; i < left.size() && !cut; ++i) {
        if (!isEar(flat, left, i)) continue;
        const std::size_t m = left.size();
        out.push_back({left[(i + m - 1) % m], left[i], left[(i + 1) % m]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
        cut = true;
      }
    }
  }
  for (std::size_t i = 1; i + 1 < left.size(); ++i) out.push_back({left[0], left[i], left[i + 1]});
}

}  // namespace glintmark
