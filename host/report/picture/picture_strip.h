// Pictures of one size side by side, each below its name.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "host/core/image.h"

namespace glintmark {

/// One row of RGB display pictures of the same size, at least one, each below its name.
Image pictureStrip(const std::vector<std::pair<std::string, Image>>& pictures);

/// Height [px] of the names above the pictures of a strip, also of one that an earlier version
/// drew: in white on black.
int stripNameHeight(const Image& strip);

/// RGB display pictures of any size below each other, on white.
Image pictureColumn(const std::vector<Image>& pictures);

}  // namespace glintmark
