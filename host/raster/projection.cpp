#include "host/raster/projection.h"

namespace glintmark {

Projection makeProjection(const Camera& camera) {
  Projection p;
  p.eye = camera.eye;
  p.near_plane = camera.near_plane;
  p.width_px = camera.width_px;
  p.height_px = camera.height_px;
  p.tiles_x = (camera.width_px + kTileSize_px - 1) / kTileSize_px;
  p.tiles_y = (camera.height_px + kTileSize_px - 1) / kTileSize_px;
  p.origin_x = kSubpixels / 2 * (camera.width_px - 1);
  p.origin_y = kSubpixels / 2 * (camera.height_px - 1);

  // point - eye = w * (ray_origin + x * ray_dx + y * ray_dy), solved for (w x, w y, w).
  const glm::dmat3 inverse =
      glm::transpose(glm::inverse(glm::dmat3(camera.ray_dx, camera.ray_dy, camera.ray_origin)));
  p.row_w = inverse[2];
  p.row_x =
      inverse[0] * static_cast<double>(kSubpixels) - static_cast<double>(p.origin_x) * p.row_w;
  p.row_y =
      inverse[1] * static_cast<double>(kSubpixels) - static_cast<double>(p.origin_y) * p.row_w;
  return p;
}

}  // namespace glintmark
