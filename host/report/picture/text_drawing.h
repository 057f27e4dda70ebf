// Text and boxes drawn into display images, with a font of its own so that pictures are the same on
// every machine.
#pragma once
#include <string_view>

#include "host/core/image.h"
#include "host/report/picture/colour_map.h"

namespace glintmark {

inline constexpr int kGlyphWidthPx = 5;
inline constexpr int kGlyphHeightPx = 7;
inline constexpr int kGlyphAdvancePx = 6;

/// Fills the pixels of [x, x + width) x [y, y + height) that lie in the RGB image.
void fillRect(Image& image, int x, int y, int width, int height, const DisplayColour& colour);

/// Draws one line of text with its top left corner at (x, y), every font pixel `scale` pixels wide.
/// Letters are drawn as capitals; characters the font lacks become a box.
void drawText(Image& image, int x, int y, std::string_view text, int scale,
              const DisplayColour& colour);

/// Width of that line in pixels.
int textWidth(std::string_view text, int scale);

}  // namespace glintmark
