#include "host/raster/camera.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <numbers>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr int kMaxSize_px = 16384;
constexpr std::int64_t kMaxPixels = std::int64_t{1} << 28;
// Sine of the angle below which two directions count as parallel.
constexpr double kParallel = 1e-9;
// Distance relative to the coordinates below which two points count as one.
constexpr double kSamePoint = 1e-13;

bool isFinite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void checkSize(int width_px, int height_px) {
  if (width_px < 1 || height_px < 1 || width_px > kMaxSize_px || height_px > kMaxSize_px)
    throw Error(fmt::format("image size {}x{} is not possible: both must be from 1 to {} pixels",
                            width_px, height_px, kMaxSize_px));
  if (std::int64_t{width_px} * height_px > kMaxPixels)
    throw Error(fmt::format("image size {}x{} is not possible: at most {} pixels in all", width_px,
                            height_px, kMaxPixels));
}

void checkView(const View& view) {
  if (!isFinite(view.eye) || !isFinite(view.target) || !isFinite(view.up))
    throw Error(fmt::format("view '{}': eye, target and up must be finite numbers", view.name));
  if (glm::length(view.target - view.eye) <= kSamePoint * glm::length(view.eye) ||
      view.target == view.eye)
    throw Error(fmt::format("view '{}': eye and target must be different points", view.name));
  if (!(view.fov_y_deg > 0 && view.fov_y_deg < 180))
    throw Error(fmt::format("view '{}': field of view must be between 0 and 180 degrees, not {}",
                            view.name, view.fov_y_deg));
  if (!(view.near_plane > 0) || !std::isfinite(view.near_plane))
    throw Error(fmt::format("view '{}': near plane must be a positive distance, not {}", view.name,
                            view.near_plane));
}

}  // namespace

Camera makeCamera(const View& view, int width_px, int height_px) {
  checkSize(width_px, height_px);
  checkView(view);

  Camera camera;
  camera.width_px = width_px;
  camera.height_px = height_px;
  camera.near_plane = view.near_plane;
  camera.eye = view.eye;
  camera.forward = glm::normalize(view.target - view.eye);

  const glm::dvec3 right = glm::cross(camera.forward, view.up);
  if (!(glm::length(right) > kParallel * glm::length(view.up)))
    throw Error(fmt::format("view '{}': up must not be parallel to the line from eye to target",
                            view.name));
  camera.right = glm::normalize(right);
  camera.up = glm::cross(camera.right, camera.forward);

  // Square pixels; the view axis goes through the middle of the image.
  const double pixel_size =
      2.0 * std::tan(view.fov_y_deg * std::numbers::pi / 360.0) / height_px;  // at distance 1
  camera.ray_dx = camera.right * pixel_size;
  camera.ray_dy = camera.up * -pixel_size;
  camera.ray_origin =
      camera.forward - 0.5 * (width_px - 1) * camera.ray_dx - 0.5 * (height_px - 1) * camera.ray_dy;
  return camera;
}

}  // namespace glintmark
