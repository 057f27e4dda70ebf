// Rasterized planes as an image for looking at.
#pragma once
#include <memory>

#include "host/core/image.h"
#include "host/core/planes.h"

namespace glintmark {

/// Every plane, from list order to the screen, one named channel per plane ("dudx",
/// "Z", ...) plus "material"; "pixel" is left out. Integer planes are written as numbers (the
/// fractions in [0, 1)), and their sums as "uv.X" and "uv.Y"; the packed frame becomes its normal
/// and tangent, "N.X" ... and "T.X" .... Pixels that no material covers are 0, and -1 in
/// "material". The planes must live as long, and hold Plane::kPixel, or Error is thrown.
class PlaneRows {
 public:
  explicit PlaneRows(const PixelPlanes& planes);
  ~PlaneRows();
  PlaneRows(const PlaneRows&) = delete;
  PlaneRows& operator=(const PlaneRows&) = delete;

  /// `count` rows from `first` on, for pictures that are too large to be held at once.
  Image read(int first, int count) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// All rows.
Image planesToImage(const PixelPlanes& planes);

/// Throws Error if there is no memory for all planes of so many pixels and for the file that rows
/// of them make.
void requireMemoryForPlanes(int width_px, int height_px);

}  // namespace glintmark
