#include <fmt/format.h>

#include <cmath>

#include "host/core/xml_escape.h"
#include "host/report/picture/chart_canvas.h"

namespace glintmark {
namespace {

std::string svgColour(const DisplayColour& colour) {
  const auto byte = [](float part) { return static_cast<int>(std::lround(part * 255)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour[0]), byte(colour[1]), byte(colour[2]));
}

}  // namespace

SvgCanvas::SvgCanvas(int width_px, int height_px)
    : elements_(
          fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                      "viewBox=\"0 0 {0} {1}\" font-family=\"Lato, sans-serif\">\n",
                      width_px, height_px)) {
  fill(0, 0, width_px, height_px, kPaper);
}

void SvgCanvas::fill(int x, int y, int width, int height, const DisplayColour& colour) {
  elements_ += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", x,
                           y, width, height, svgColour(colour));
}

// Each clip box is an element of its own, which the next shape names.
std::string SvgCanvas::clipAttribute(const ClipBox& clip) {
  elements_ += fmt::format(
      "<clipPath id=\"c{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n",
      clips_, clip.left, clip.top, clip.right - clip.left, clip.bottom - clip.top);
  return fmt::format("clip-path=\"url(#c{})\"", clips_++);
}

void SvgCanvas::polyline(std::span<const glm::dvec2> points, double width_px,
                         const DisplayColour& colour, const ClipBox& clip) {
  const std::string clipped = clipAttribute(clip);
  std::string places;
  for (const glm::dvec2 point : points)
    places += fmt::format("{}{:.2f},{:.2f}", places.empty() ? "" : " ", point.x, point.y);
  elements_ += fmt::format(
      "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
      "stroke-linecap=\"round\" stroke-linejoin=\"round\" {}/>\n",
      places, svgColour(colour), width_px, clipped);
}

void SvgCanvas::dot(glm::dvec2 centre, double radius_px, const DisplayColour& colour,
                    const ClipBox& clip) {
  const std::string clipped = clipAttribute(clip);
  elements_ += fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\" {}/>\n",
                           centre.x, centre.y, radius_px, svgColour(colour), clipped);
}

void SvgCanvas::addText(const std::string& place, const char* anchor, std::string_view text,
                        const TextStyle& style) {
  if (text.empty()) return;
  elements_ += fmt::format("<text {} text-anchor=\"{}\" font-size=\"{}\" fill=\"{}\"{}>{}</text>\n",
                           place, anchor, style.size_px, svgColour(style.colour),
                           style.weight == TextWeight::kBold ? " font-weight=\"bold\"" : "",
                           escapedXml(text));
}

void SvgCanvas::text(int x, int baseline_y, std::string_view text, const TextStyle& style,
                     TextAlign align) {
  const char* anchor = align == TextAlign::kLeft     ? "start"
                       : align == TextAlign::kCentre ? "middle"
                                                     : "end";
  addText(fmt::format("x=\"{}\" y=\"{}\"", x, baseline_y), anchor, text, style);
}

void SvgCanvas::textUpwards(int x, int y, std::string_view text, const TextStyle& style) {
  // The middle of capitals stands 0.36 of the em above their baseline.
  addText(
      fmt::format("transform=\"translate({:.1f} {}) rotate(-90)\"", x + 0.36 * style.size_px, y),
      "middle", text, style);
}

std::string SvgCanvas::take() {
  return std::move(elements_) + "</svg>\n";
}

}  // namespace glintmark
