// The planes that the rasterizer writes and the kernels read: one 4-byte value per listed pixel.
//
// Planes are stored in the order of the pixel lists, not of the screen, so that W lanes of a kernel
// load W neighbouring entries and pixels that no material covers take no room at all.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <span>
#include <vector>

namespace glintmark {

/// Every plane the rasterizer can make. The type named is that of the stored 4 bytes.
enum class Plane : std::uint32_t {
  kPixel,   // uint: y << 16 | x
  kUInt,    // int: floor(u)
  kVInt,    // int: floor(v)
  kUFrac,   // uint: (u - floor(u)) * 2^32
  kVFrac,   // uint: (v - floor(v)) * 2^32
  kDudx,    // float: du/dx, uv per pixel to the right
  kDvdx,    // float
  kDudy,    // float: du/dy, uv per pixel down
  kDvdy,    // float
  kFrame0,  // uint: packed shading frame, see frame_packing.h
  kFrame1,  // uint
  kDepth,   // float: distance along the view axis, world units
  kDnxDx,   // float: x, world axes, of how the interpolated normal changes per pixel to the right,
  kDnyDx,   // over its length; what lies along the normal itself is not taken out
  kDnzDx,   // float
  kDnxDy,   // float: the same per pixel down
  kDnyDy,   // float
  kDnzDy,   // float
  kCount
};
inline constexpr std::size_t kPlaneCount = static_cast<std::size_t>(Plane::kCount);

/// A set of planes.
class PlaneMask {
 public:
  constexpr PlaneMask() = default;
  constexpr PlaneMask(std::initializer_list<Plane> planes) {
    for (Plane p : planes) bits_ |= bit(p);
  }
  constexpr bool has(Plane p) const { return (bits_ & bit(p)) != 0; }
  constexpr PlaneMask operator|(PlaneMask o) const { return PlaneMask(bits_ | o.bits_); }
  constexpr bool operator==(const PlaneMask&) const = default;
  constexpr bool hasAnyOf(PlaneMask o) const { return (bits_ & o.bits_) != 0; }
  constexpr std::uint32_t bits() const { return bits_; }
  constexpr std::size_t size() const { return static_cast<std::size_t>(__builtin_popcount(bits_)); }
  /// Position of plane `p` among the planes of this set, in enum order; `p` must be in the set.
  constexpr std::size_t slot(Plane p) const {
    return static_cast<std::size_t>(__builtin_popcount(bits_ & (bit(p) - 1u)));
  }
  static constexpr PlaneMask all() { return PlaneMask((1u << kPlaneCount) - 1u); }

 private:
  explicit constexpr PlaneMask(std::uint32_t bits) : bits_(bits) {}
  static constexpr std::uint32_t bit(Plane p) { return 1u << static_cast<std::uint32_t>(p); }
  std::uint32_t bits_ = 0;
};

/// How the interpolated normal changes from pixel to pixel.
inline constexpr PlaneMask kNormalSteps = {Plane::kDnxDx, Plane::kDnyDx, Plane::kDnzDx,
                                           Plane::kDnxDy, Plane::kDnyDy, Plane::kDnzDy};
/// What is made of the mesh's normals and tangents.
inline constexpr PlaneMask kFramePlanes = kNormalSteps | PlaneMask{Plane::kFrame0, Plane::kFrame1};

/// The covered pixels of one material: entries [offset, offset + count) of every plane.
/// `offset` is a multiple of GM_LIST_PADDING; entries up to the next multiple repeat the last one.
struct PixelList {
  std::uint32_t material = 0;
  std::uint32_t offset = 0;
  std::uint32_t count = 0;
};

/// Page-aligned (4096-byte) 4-byte words that keep their memory from frame to frame and are never
/// cleared. An OpenCL CPU device can use them in place.
class PlaneStorage {
 public:
  /// Makes room for `words` words; contents are undefined after growth. Returns true if it moved.
  bool reserve(std::size_t words) {
    if (words <= capacity_) return false;
    capacity_ = words + words / 8;
    words_.reset(
        static_cast<std::uint32_t*>(::operator new (capacity_ * 4, std::align_val_t{4096})));
    return true;
  }
  std::uint32_t* data() const { return words_.get(); }
  std::size_t capacity() const { return capacity_; }

 private:
  struct Free {
    void operator()(std::uint32_t* p) const { ::operator delete (p, std::align_val_t{4096}); }
  };
  std::unique_ptr<std::uint32_t[], Free> words_;
  std::size_t capacity_ = 0;
};

/// What one rasterized view hands to the shading kernels.
struct PixelPlanes {
  int width_px = 0;
  int height_px = 0;
  PlaneMask mask;
  std::size_t stride = 0;        // entries per plane, a multiple of GM_LIST_PADDING
  PlaneStorage storage;          // plane p starts at word mask.slot(p) * stride
  std::vector<PixelList> lists;  // only materials that cover at least one pixel, ascending
  std::size_t covered_px = 0;    // sum of the lists' counts

  template <typename T = std::uint32_t>
  std::span<T> plane(Plane p) const {
    static_assert(sizeof(T) == 4);
    return {reinterpret_cast<T*>(storage.data()) + mask.slot(p) * stride, stride};
  }
};

}  // namespace glintmark
