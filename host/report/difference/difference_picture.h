// False colours of a map of errors.
#pragma once
#include <string>

#include "host/core/image.h"

namespace glintmark {

/// The map in false colours from 0 to `top` (> 0; more takes the last colour, NaN the first), below
/// it a title and the colours' scale. Display values, RGB; the map keeps its size at the top left.
Image differencePicture(const Image& map, double top, const std::string& title);

/// The same in linear light, and the map itself in a fourth channel `name`: for an EXR file.
Image differenceLayers(const Image& map, double top, const std::string& title,
                       const std::string& name);

}  // namespace glintmark
