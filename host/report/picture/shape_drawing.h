// Lines and dots with smooth edges, drawn into display images.
#pragma once
#include <glm/vec2.hpp>
#include <span>

#include "host/core/image.h"
#include "host/report/picture/colour_map.h"

namespace glintmark {

/// Pixels that may be drawn to: [left, right) x [top, bottom).
struct ClipBox {
  int left = 0, top = 0, right = 0, bottom = 0;
};

/// Draws the line through `points`, in pixels with whole numbers at the corners of pixels, with
/// round joints and ends.
void drawPolyline(Image& image, std::span<const glm::dvec2> points, double width_px,
                  const DisplayColour& colour, const ClipBox& clip);

/// Draws a filled disc.
void drawDot(Image& image, glm::dvec2 centre, double radius_px, const DisplayColour& colour,
             const ClipBox& clip);

}  // namespace glintmark
