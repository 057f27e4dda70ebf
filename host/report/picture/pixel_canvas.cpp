#include "host/report/picture/chart_canvas.h"

namespace glintmark {

PixelCanvas::PixelCanvas(int width_px, int height_px) : image_(width_px, height_px, 3) {
  fill(0, 0, width_px, height_px, kPaper);
}

void PixelCanvas::fill(int x, int y, int width, int height, const DisplayColour& colour) {
  fillRect(image_, x, y, width, height, colour);
}

void PixelCanvas::polyline(std::span<const glm::dvec2> points, double width_px,
                           const DisplayColour& colour, const ClipBox& clip) {
  drawPolyline(image_, points, width_px, colour, clip);
}

void PixelCanvas::dot(glm::dvec2 centre, double radius_px, const DisplayColour& colour,
                      const ClipBox& clip) {
  drawDot(image_, centre, radius_px, colour, clip);
}

void PixelCanvas::text(int x, int baseline_y, std::string_view text, const TextStyle& style,
                       TextAlign align) {
  drawText(image_, x, baseline_y, text, style, align);
}

void PixelCanvas::textUpwards(int x, int y, std::string_view text, const TextStyle& style) {
  drawTurnedText(image_, x, y, text, style, TextTurn::kUpwards);
}

}  // namespace glintmark
