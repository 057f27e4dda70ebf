// What charts are drawn on: pixels, or the elements of an SVG file.
#pragma once
#include <glm/vec2.hpp>
#include <span>
#include <string>
#include <string_view>

#include "host/core/image.h"
#include "host/report/picture/shape_drawing.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {

/// Lengths in pixels; whole numbers at the corners of pixels, y downwards.
class ChartCanvas {
 public:
  virtual ~ChartCanvas() = default;
  virtual void fill(int x, int y, int width, int height, const DisplayColour& colour) = 0;
  /// A line through points, with round joints and ends; nothing beyond `clip`.
  virtual void polyline(std::span<const glm::dvec2> points, double width_px,
                        const DisplayColour& colour, const ClipBox& clip) = 0;
  virtual void dot(glm::dvec2 centre, double radius_px, const DisplayColour& colour,
                   const ClipBox& clip) = 0;
  virtual void text(int x, int baseline_y, std::string_view text, const TextStyle& style,
                    TextAlign align) = 0;
  /// Reads upwards, its middle at (x, y).
  virtual void textUpwards(int x, int y, std::string_view text, const TextStyle& style) = 0;
};

/// White paper of pixels.
class PixelCanvas : public ChartCanvas {
 public:
  PixelCanvas(int width_px, int height_px);
  void fill(int x, int y, int width, int height, const DisplayColour& colour) override;
  void polyline(std::span<const glm::dvec2> points, double width_px, const DisplayColour& colour,
                const ClipBox& clip) override;
  void dot(glm::dvec2 centre, double radius_px, const DisplayColour& colour,
           const ClipBox& clip) override;
  void text(int x, int baseline_y, std::string_view text, const TextStyle& style,
            TextAlign align) override;
  void textUpwards(int x, int y, std::string_view text, const TextStyle& style) override;
  /// What was drawn; the canvas is empty then.
  Image take() { return std::move(image_); }

 private:
  Image image_;
};

/// An SVG 1.1 document with white paper. Text is text, in Lato where the reader has it.
class SvgCanvas : public ChartCanvas {
 public:
  SvgCanvas(int width_px, int height_px);
  void fill(int x, int y, int width, int height, const DisplayColour& colour) override;
  void polyline(std::span<const glm::dvec2> points, double width_px, const DisplayColour& colour,
                const ClipBox& clip) override;
  void dot(glm::dvec2 centre, double radius_px, const DisplayColour& colour,
           const ClipBox& clip) override;
  void text(int x, int baseline_y, std::string_view text, const TextStyle& style,
            TextAlign align) override;
  void textUpwards(int x, int y, std::string_view text, const TextStyle& style) override;
  /// The whole document.
  std::string take();

 private:
  std::string clipAttribute(const ClipBox& clip);
  void addText(const std::string& place, const char* anchor, std::string_view text,
               const TextStyle& style);

  std::string elements_;
  int clips_ = 0;
};

}  // namespace glintmark
