// The false colours as a bar with its values below, the legend of every picture that uses them.
#pragma once
#include "host/core/image.h"

namespace glintmark {

struct ColourScale {
  double low = 0, high = 1;  // values at the ends
  int intervals = 5;         // between labels
  int decimals = -1;         // of the labels; -1: one where a label needs it
};

/// Draws the bar with its top left corner at (x, y); text of `size_px`.
void drawColourScale(Image& image, int x, int y, int width, const ColourScale& scale, int size_px);

/// Height of all that, down to the baseline of the labels.
int colourScaleHeight(int size_px);

}  // namespace glintmark
