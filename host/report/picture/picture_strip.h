// Pictures of one size side by side, each under its name.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "host/core/image.h"

namespace glintmark {

/// One row of RGB display pictures of the same size, at least one.
Image pictureStrip(const std::vector<std::pair<std::string, Image>>& pictures);

/// RGB display pictures of any size below each other, on white.
Image pictureColumn(const std::vector<Image>& pictures);

}  // namespace glintmark
