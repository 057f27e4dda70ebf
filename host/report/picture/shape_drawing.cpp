#include "host/report/picture/shape_drawing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

double distanceToSegment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
  const glm::dvec2 along = b - a;
  const double length_sq = glm::dot(along, along);
  const double t = length_sq > 0 ? std::clamp(glm::dot(p - a, along) / length_sq, 0.0, 1.0) : 0;
  return glm::length(p - (a + t * along));
}

}  // namespace

void drawPolyline(Image& image, std::span<const glm::dvec2> points, double width_px,
                  const DisplayColour& colour, const ClipBox& clip) {
  const int left = std::max(clip.left, 0), top = std::max(clip.top, 0);
  const int right = std::min(clip.right, image.width), bottom = std::min(clip.bottom, image.height);
  if (right <= left || bottom <= top) return;
  // The greatest share of any segment: where two meet, nothing is drawn twice.
  std::vector<float> share(static_cast<std::size_t>(right - left) * (bottom - top));
  const double reach = width_px / 2 + 1;
  for (std::size_t i = 0; i + 1 < points.size() || (i == 0 && points.size() == 1); ++i) {
    const glm::dvec2 a = points[i], b = points[std::min(i + 1, points.size() - 1)];
    const int x0 = std::max(left, static_cast<int>(std::floor(std::min(a.x, b.x) - reach)));
    const int x1 = std::min(right, static_cast<int>(std::ceil(std::max(a.x, b.x) + reach)));
    const int y0 = std::max(top, static_cast<int>(std::floor(std::min(a.y, b.y) - reach)));
    const int y1 = std::min(bottom, static_cast<int>(std::ceil(std::max(a.y, b.y) + reach)));
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        const double distance = distanceToSegment({x + 0.5, y + 0.5}, a, b);
        const auto covered =
            static_cast<float>(std::clamp(width_px / 2 + 0.5 - distance, 0.0, 1.0));
        float& greatest = share[static_cast<std::size_t>(y - top) * (right - left) + (x - left)];
        greatest = std::max(greatest, covered);
      }
  }
  for (int y = top; y < bottom; ++y)
    for (int x = left; x < right; ++x)
      blendPixel(image, x, y, colour,
                 share[static_cast<std::size_t>(y - top) * (right - left) + (x - left)]);
}

void drawDot(Image& image, glm::dvec2 centre, double radius_px, const DisplayColour& colour,
             const ClipBox& clip) {
  drawPolyline(image, {&centre, 1}, 2 * radius_px, colour, clip);
}

}  // namespace glintmark
