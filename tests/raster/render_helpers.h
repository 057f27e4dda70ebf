// Rendering and reading planes back, for the rasterizer's tests.
#pragma once
#include <array>
#include <cmath>
#include <cstring>

#include "host/core/frame_packing.h"
#include "host/raster/rasterizer.h"
#include "tests/raster/test_meshes.h"

namespace glintmark::test {

inline PixelPlanes renderAll(const TriangleMesh& mesh, const Camera& camera,
                             bool cull_back_faces = false, int threads = 0,
                             PlaneMask mask = PlaneMask::all()) {
  PixelPlanes planes;
  Rasterizer(threads).render(mesh, camera, cull_back_faces, mask, planes);
  return planes;
}

/// Entry of pixel (x, y), or -1.
inline std::ptrdiff_t entryOf(const PixelPlanes& planes, int x, int y) {
  const auto pixel = planes.plane(Plane::kPixel);
  for (const PixelList& list : planes.lists)
    for (std::size_t i = list.offset; i < list.offset + list.count; ++i)
      if (pixel[i] == (static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x)))
        return static_cast<std::ptrdiff_t>(i);
  return -1;
}

/// Calls body(entry, x, y, material) for every listed pixel.
template <class Body>
void forEachPixel(const PixelPlanes& planes, const Body& body) {
  const auto pixel = planes.plane(Plane::kPixel);
  for (const PixelList& list : planes.lists)
    for (std::size_t i = list.offset; i < list.offset + list.count; ++i)
      body(i, static_cast<int>(pixel[i] & 0xFFFF), static_cast<int>(pixel[i] >> 16), list.material);
}

/// What the planes say of one entry.
struct PixelAttributes {
  glm::dvec2 uv_floor, uv_fraction;  // the sum would round at 1e6
  glm::dvec2 duv_dx, duv_dy;
  glm::dvec3 normal_dx, normal_dy;  // over the normal's length
  double depth;
  PackedFrame packed;
  ShadingFrame frame;
  bool mirrored;
};

inline PixelAttributes readEntry(const PixelPlanes& planes, std::size_t i) {
  const auto real = [&](Plane p) { return static_cast<double>(planes.plane<float>(p)[i]); };
  const auto fraction = [&](Plane p) { return std::ldexp(double(planes.plane(p)[i]), -32); };
  const auto whole = [&](Plane p) { return static_cast<double>(planes.plane<std::int32_t>(p)[i]); };
  PixelAttributes a;
  a.uv_floor = {whole(Plane::kUInt), whole(Plane::kVInt)};
  a.uv_fraction = {fraction(Plane::kUFrac), fraction(Plane::kVFrac)};
  a.duv_dx = {real(Plane::kDudx), real(Plane::kDvdx)};
  a.duv_dy = {real(Plane::kDudy), real(Plane::kDvdy)};
  a.normal_dx = {real(Plane::kDnxDx), real(Plane::kDnyDx), real(Plane::kDnzDx)};
  a.normal_dy = {real(Plane::kDnxDy), real(Plane::kDnyDy), real(Plane::kDnzDy)};
  a.depth = real(Plane::kDepth);
  a.packed = {planes.plane(Plane::kFrame0)[i], planes.plane(Plane::kFrame1)[i]};
  a.frame = unpackFrame(a.packed);
  a.mirrored = a.packed.frame1 >> 31 != 0;
  return a;
}

/// Every listed value is a number: no NaN or infinity in the float planes.
inline bool allFinite(const PixelPlanes& planes) {
  bool finite = true;
  for (const Plane p : {Plane::kDudx, Plane::kDvdx, Plane::kDudy, Plane::kDvdy, Plane::kDepth})
    forEachPixel(planes, [&](std::size_t i, int, int, std::uint32_t) {
      finite &= std::isfinite(planes.plane<float>(p)[i]);
    });
  return finite;
}

inline double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// True if both hold the same lists and the same bits in every plane.
inline bool identical(const PixelPlanes& a, const PixelPlanes& b) {
  if (a.mask != b.mask || a.stride != b.stride || a.covered_px != b.covered_px ||
      a.lists.size() != b.lists.size())
    return false;
  for (std::size_t i = 0; i < a.lists.size(); ++i)
    if (a.lists[i].material != b.lists[i].material || a.lists[i].offset != b.lists[i].offset ||
        a.lists[i].count != b.lists[i].count)
      return false;
  return a.stride == 0 ||
         std::memcmp(a.storage.data(), b.storage.data(), a.stride * a.mask.size() * 4) == 0;
}

}  // namespace glintmark::test
