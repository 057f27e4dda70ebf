// From world space to the fixed-point pixel grid.
//
// Screen positions are integers in sub-pixels (1/256 px), x to the right, y down, measured from the
// middle of the image. The centre of pixel i lies at kSubpixels * i - origin, a whole number. With
// integer positions every edge function is exact, so triangles that share an edge neither leave a
// crack nor cover a pixel twice.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

#include "host/raster/camera.h"

namespace glintmark {

inline constexpr int kSubpixelBits = 8;
inline constexpr int kSubpixels = 1 << kSubpixelBits;

/// Vertices farther than this from the middle of the image [sub-pixels] are clipped: products of
/// two coordinate differences stay below 2^48, exact in double precision. The largest image reaches
/// half as far.
inline constexpr std::int32_t kGuardBand = 1 << 22;

inline constexpr int kTileSize_px = 32;
inline constexpr int kTilePixels = kTileSize_px * kTileSize_px;

/// Value of ScreenVertex::x that says: outside the near plane or the guard band, or not a number.
inline constexpr std::int32_t kNeedsClipping = std::numeric_limits<std::int32_t>::min();

/// A projected vertex, 16 bytes so that three gathers touch one cache line.
struct ScreenVertex {
  std::int32_t x = 0, y = 0;  // [sub-pixels]
  float inverse_depth = 0;    // 1 / distance along the view axis: nearer is larger
  std::uint32_t unused = 0;
};

/// (X, Y, w) of a point p in world space: dot(row, p - eye). X / w and Y / w are sub-pixels.
struct Projection {
  glm::dvec3 eye{};
  glm::dvec3 row_x{}, row_y{}, row_w{};
  double near_plane = 0;
  std::int32_t origin_x = 0, origin_y = 0;  // pixel i is centred at kSubpixels * i - origin
  int width_px = 0, height_px = 0;
  int tiles_x = 0, tiles_y = 0;

  glm::dvec3 apply(const glm::dvec3& p) const {
    const glm::dvec3 d = p - eye;
    return {row_x.x * d.x + row_x.y * d.y + row_x.z * d.z,
            row_y.x * d.x + row_y.y * d.y + row_y.z * d.z,
            row_w.x * d.x + row_w.y * d.y + row_w.z * d.z};
  }
};

/// The inverse of camera.ray(x, y) * depth, in sub-pixels.
Projection makeProjection(const Camera& camera);

}  // namespace glintmark
