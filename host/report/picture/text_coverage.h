// Glyphs of a font file, drawn by OpenImageIO.
#pragma once
#include <filesystem>
#include <string>

#include "host/core/image.h"

namespace glintmark {

/// The ink of one line of text: what share of each pixel it covers, in [0, 1], one channel.
struct TextCoverage {
  Image share;            // of the smallest box of pixels around the ink; empty without text
  int left = 0, top = 0;  // of the box, from the point on the baseline where the text begins
};

/// Renders ASCII text with `size_px` pixels to the em. OpenImageIO places glyphs on whole pixels,
/// so it is made four times as large and averaged. Throws Error if the font cannot be used.
TextCoverage textCoverage(const std::string& text, int size_px, const std::filesystem::path& font);

}  // namespace glintmark
