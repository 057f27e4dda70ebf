// False colours for scalar images.
#pragma once
#include <array>

namespace glintmark {

/// sRGB display colour, each component in [0, 1].
using DisplayColour = std::array<float, 3>;

/// Colour of `t`, clamped to [0, 1]; NaN gives the colour of 0. Perceptually even: in OKLCh the
/// lightness rises linearly from 0.25 to 0.95 while the hue turns from violet (300 deg) through
/// blue and green to yellow (100 deg), and the chroma is what sRGB can show, at most 0.17. So the
/// picture also reads in grey and by colour-blind eyes.
DisplayColour falseColour(double t);

}  // namespace glintmark
