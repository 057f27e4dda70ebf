// A View at a given image size: the pixel grid's rays and the projection, in double precision.
#pragma once
#include <glm/glm.hpp>

#include "host/scene/scene.h"

namespace glintmark {

struct Camera {
  int width_px = 0;
  int height_px = 0;
  double near_plane = 0;
  glm::dvec3 eye{};
  glm::dvec3 forward{}, right{}, up{};  // orthonormal, right-handed: right x up = -forward
  // World-space ray through the centre of pixel (x, y), not normalised, with dot(ray, forward) = 1:
  // ray_origin + x * ray_dx + y * ray_dy. Pixel (0, 0) is the top left; its centre is at (0, 0)
  // in this parameterization.
  glm::dvec3 ray_origin{}, ray_dx{}, ray_dy{};

  glm::dvec3 ray(double x, double y) const { return ray_origin + x * ray_dx + y * ray_dy; }
};

/// Throws Error for a size outside 1..16384 in either direction or above 2^28 pixels in all, for a
/// view whose eye and target coincide or whose up is parallel to the view axis, for a field of view
/// outside (0, 180) and for a near plane that is not positive.
Camera makeCamera(const View& view, int width_px, int height_px);

}  // namespace glintmark
