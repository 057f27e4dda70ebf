// Text and boxes drawn into display images.
#pragma once
#include <string_view>

#include "host/core/image.h"
#include "host/report/picture/colour_map.h"

namespace glintmark {

// What all pictures are drawn with. Soft ink is for what comes second: units, ticks, statistics.
inline constexpr DisplayColour kPaper = {1, 1, 1};
inline constexpr DisplayColour kInk = {0.11f, 0.12f, 0.14f};
inline constexpr DisplayColour kSoftInk = {0.36f, 0.39f, 0.43f};
inline constexpr DisplayColour kGridInk = {0.90f, 0.91f, 0.92f};

enum class TextWeight { kRegular, kBold };
enum class TextAlign { kLeft, kCentre, kRight };  // what of the text stands at the given x

struct TextStyle {
  int size_px = 13;  // of the em; capitals are 0.72 of it high
  DisplayColour colour = kInk;
  TextWeight weight = TextWeight::kRegular;
};

/// Size of text [px] that is still legible when a picture of that width is shown on a page.
int textSizeFor(int picture_width_px);

/// Fills the pixels of [x, x + width) x [y, y + height) that lie in the RGB image.
void fillRect(Image& image, int x, int y, int width, int height, const DisplayColour& colour);

/// Mixes `share` in [0, 1] of the colour into a pixel, if it lies in the RGB image.
void blendPixel(Image& image, int x, int y, const DisplayColour& colour, float share);

/// Draws one line of text in Lato, whose digits are all equally wide. Characters other than ASCII
/// become a question mark. Throws Error if the font is not installed.
void drawText(Image& image, int x, int baseline_y, std::string_view text, const TextStyle& style,
              TextAlign align = TextAlign::kLeft);

/// Draws one line of text turned by a quarter to the right, so that it reads downwards; or to the
/// left, upwards. Its middle is at (x, y).
enum class TextTurn { kDownwards, kUpwards };
void drawTurnedText(Image& image, int x, int y, std::string_view text, const TextStyle& style,
                    TextTurn turn);

/// Width of that line in pixels, blanks at its end left out.
int textWidth(std::string_view text, const TextStyle& style);

/// The style with the greatest size, of at least 8 px, at which the text is no wider than
/// `width_px`.
TextStyle fitted(TextStyle style, std::string_view text, int width_px);

}  // namespace glintmark
