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
  double most = 0;  // value of the brightest colour; 0: the greatest there is
};

/// Discs in rows of `columns`, areas in proportion to solid angles, +x to the right, in false
/// colours from 0 on, captions below.
Image lobePicture(const std::vector<LobeDisc>& discs, int columns);

/// One disc per order and side, each scaled to its own greatest cell.
Image histogramPicture(const Simulation& simulation);

}  // namespace glintmark
