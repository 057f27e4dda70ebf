// Pictures of scattered light by direction.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/simulate/simulation.h"

namespace glintmark {

/// A hemisphere of directions: value for the cosine from the normal and the azimuth [rad].
struct LobeDisc {
  std::string caption;
  std::function<double(double cosine, double azimuth)> value;
  double most = 0;     // value of the brightest colour; 0: the greatest there is
  std::string note{};  // a second line below
  bool compass =
      false;  // rings at 30 and 60 degrees from the normal, and a cross for the light at:
  double light_cosine = 1, light_azimuth = 0;
};

/// Discs in rows of `columns`, areas in proportion to solid angles, +x to the right, in false
/// colours from 0 on, captions below.
Image lobePicture(const std::vector<LobeDisc>& discs, int columns);

/// A legend and one disc per order and side: energy per solid angle, in cells so wide that the
/// brightest has 200 rays where there are as many, each disc scaled to its own brightest cell.
Image histogramPicture(const Simulation& simulation);

}  // namespace glintmark
