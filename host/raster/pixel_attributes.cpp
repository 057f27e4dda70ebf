#include "host/raster/pixel_attributes.h"

#include <algorithm>
#include <cstring>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "host/raster/pixel_attributes.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "host/raster/frame_packing-inl.h"

HWY_BEFORE_NAMESPACE();
namespace glintmark::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::ScalableTag<double>;
using I64 = hn::RebindToSigned<F64>;
using U64 = hn::RebindToUnsigned<F64>;
using F32H = hn::Rebind<float, F64>;
using I32H = hn::Rebind<std::int32_t, F64>;
using U32H = hn::Rebind<std::uint32_t, F64>;
using VD = hn::Vec<F64>;

// Pixels are evaluated in blocks, first into here: whole vectors, whatever the count.
constexpr std::size_t kBlock = 64;
constexpr Plane kStepPlanes[2][3] = {{Plane::kDnxDx, Plane::kDnyDx, Plane::kDnzDx},
                                     {Plane::kDnxDy, Plane::kDnyDy, Plane::kDnzDy}};
struct Block {
  alignas(64) std::uint32_t planes[kPlaneCount][kBlock];
  alignas(64) float b1[kBlock], b2[kBlock];
  // How barycentrics change per pixel: [0] to the right, [1] down.
  alignas(64) float b1_step[2][kBlock], b2_step[2][kBlock];
  std::uint32_t* plane(Plane p) { return planes[static_cast<std::size_t>(p)]; }
  float* floats(Plane p) { return reinterpret_cast<float*>(plane(p)); }
};

// Reads a field of the table for the triangles of one vector of pixels.
template <bool kOneTriangle>
struct DoubleReader {
  const AttributeTable& table;
  std::uint32_t slot;
  hn::Vec<I64> slots;
  HWY_INLINE VD operator()(DoubleField f) const {
    if constexpr (kOneTriangle) return hn::Set(F64(), table.field(f)[slot]);
    return hn::GatherIndex(F64(), table.field(f), slots);
  }
};

HWY_INLINE void storeFloat(VD value, float* to) {
  const F32H df;
  const auto limit = hn::Set(df, std::numeric_limits<float>::max());
  hn::StoreU(hn::Max(hn::Min(hn::DemoteTo(df, value), limit), hn::Neg(limit)), df, to);
}

// uv in fixed point: the floor in the upper half of 64 bits, the fraction in the lower.
HWY_INLINE void storeUv(VD value, std::uint32_t* whole, std::uint32_t* fraction) {
  const U32H du;
  const auto scaled = hn::Floor(hn::Mul(value, hn::Set(F64(), 4294967296.0)));
  const auto bits = hn::BitCast(U64(), hn::ConvertTo(I64(), scaled));
  hn::StoreU(hn::TruncateTo(du, hn::ShiftRight<32>(bits)), du, whole);
  hn::StoreU(hn::TruncateTo(du, bits), du, fraction);
}

HWY_INLINE VD clampUnit(VD b) {
  const F64 d;
  return hn::Max(hn::Min(b, hn::Set(d, 1.0)), hn::Zero(d));
}

// One vector of pixels: everything in double precision.
template <bool kOneTriangle>
HWY_INLINE void evaluateVector(const DoubleReader<kOneTriangle>& read, hn::Vec<I32H> pixel,
                               PlaneMask mask, std::size_t at, Block& block) {
  const F64 d;
  const I32H di;
  const F32H df;
  const VD x = hn::PromoteTo(d, hn::And(pixel, hn::Set(di, 0xFFFF)));
  const VD y = hn::PromoteTo(d, hn::ShiftRight<16>(pixel));
  const auto linear = [&](VD constant, VD dx, VD dy)
                          HWY_ATTR { return hn::MulAdd(dy, y, hn::MulAdd(dx, x, constant)); };
  const VD q_dx = read(kQdx), q_dy = read(kQdy);
  const VD q = hn::Max(linear(read(kQ), q_dx, q_dy), read(kQMin));
  const VD t = hn::Div(hn::Set(d, 1.0), q);
  const VD g1_dx = read(kG1dx), g1_dy = read(kG1dy), g2_dx = read(kG2dx), g2_dy = read(kG2dy);
  // A centre that only rounding to sub-pixels puts inside gets the attributes of the border.
  const VD b1 = clampUnit(hn::Mul(linear(read(kG1), g1_dx, g1_dy), t));
  const VD b2 = clampUnit(hn::Mul(linear(read(kG2), g2_dx, g2_dy), t));
  hn::StoreU(hn::DemoteTo(df, b1), df, block.b1 + at);
  hn::StoreU(hn::DemoteTo(df, b2), df, block.b2 + at);
  if (mask.has(Plane::kDepth)) storeFloat(t, block.floats(Plane::kDepth) + at);

  const VD du1 = read(kDu1), dv1 = read(kDv1), du2 = read(kDu2), dv2 = read(kDv2);
  const auto mix = [](VD p, VD s, VD r, VD w) HWY_ATTR { return hn::MulAdd(p, s, hn::Mul(r, w)); };
  storeUv(hn::MulAdd(b2, du2, hn::MulAdd(b1, du1, read(kU0))), block.plane(Plane::kUInt) + at,
          block.plane(Plane::kUFrac) + at);
  storeUv(hn::MulAdd(b2, dv2, hn::MulAdd(b1, dv1, read(kV0))), block.plane(Plane::kVInt) + at,
          block.plane(Plane::kVFrac) + at);

  // Quotient rule on b = g / q.
  const auto derivative = [&](VD g, VD b, VD dq)
                              HWY_ATTR { return hn::Mul(hn::NegMulAdd(b, dq, g), t); };
  const VD b1_dx = derivative(g1_dx, b1, q_dx), b2_dx = derivative(g2_dx, b2, q_dx);
  const VD b1_dy = derivative(g1_dy, b1, q_dy), b2_dy = derivative(g2_dy, b2, q_dy);
  storeFloat(mix(b1_dx, du1, b2_dx, du2), block.floats(Plane::kDudx) + at);
  storeFloat(mix(b1_dx, dv1, b2_dx, dv2), block.floats(Plane::kDvdx) + at);
  storeFloat(mix(b1_dy, du1, b2_dy, du2), block.floats(Plane::kDudy) + at);
  storeFloat(mix(b1_dy, dv1, b2_dy, dv2), block.floats(Plane::kDvdy) + at);
  if (!mask.hasAnyOf(kNormalSteps)) return;
  storeFloat(b1_dx, block.b1_step[0] + at);
  storeFloat(b2_dx, block.b2_step[0] + at);
  storeFloat(b1_dy, block.b1_step[1] + at);
  storeFloat(b2_dy, block.b2_step[1] + at);
}

template <class V>
HWY_INLINE bool allSame(V slots, std::int32_t first) {
  const hn::DFromV<V> d;
  return hn::AllTrue(d, hn::Eq(slots, hn::Set(d, first)));
}

HWY_INLINE void evaluateBarycentrics(const AttributeTable& table, const std::int32_t* slots,
                                     const std::int32_t* pixels, std::size_t count, PlaneMask mask,
                                     Block& block) {
  const I32H di;
  for (std::size_t i = 0; i < count; i += hn::Lanes(di)) {
    const auto pixel = hn::LoadU(di, pixels + i);
    const auto slot = hn::LoadU(di, slots + i);
    const auto first = static_cast<std::uint32_t>(slots[i]);
    const auto wide = hn::PromoteTo(I64(), slot);
    if (allSame(slot, slots[i]))
      evaluateVector(DoubleReader<true>{table, first, wide}, pixel, mask, i, block);
    else
      evaluateVector(DoubleReader<false>{table, first, wide}, pixel, mask, i, block);
  }
}

// Changes of the normal, over its length. Steps may be as large as a float: what overflows is
// cut where uv derivatives are.
template <class Read>
HWY_INLINE void storeNormalSteps(const Read& read, const FrameVector& normal, std::size_t i,
                                 Block& block) {
  const FrameF d;
  const auto limit = hn::Set(d, std::numeric_limits<float>::max());
  const auto length_sq =
      hn::MulAdd(normal.x, normal.x, hn::MulAdd(normal.y, normal.y, hn::Mul(normal.z, normal.z)));
  const auto inverse = hn::Div(hn::Set(d, 1.0f), hn::Sqrt(hn::Max(length_sq, hn::Set(d, 1e-30f))));
  for (std::size_t step = 0; step < 2; ++step)
    for (std::size_t component = 0; component < 3; ++component) {
      const auto change =
          hn::MulAdd(hn::Load(d, block.b2_step[step] + i), read(kNormalD2 + component),
                     hn::Mul(hn::Load(d, block.b1_step[step] + i), read(kNormalD1 + component)));
      const auto bounded = hn::Max(hn::Min(hn::Mul(change, inverse), limit), hn::Neg(limit));
      hn::Store(hn::IfThenElseZero(hn::Eq(bounded, bounded), bounded), d,
                block.floats(kStepPlanes[step][component]) + i);
    }
}

template <bool kOneTriangle>
HWY_INLINE void packVector(const AttributeTable& table, const std::int32_t* slots, std::size_t i,
                           bool with_steps, Block& block) {
  const FrameF d;
  const FrameU du;
  const auto slot = hn::LoadU(FrameI(), slots + i);
  const auto read = [&](std::size_t field) HWY_ATTR {
    if constexpr (kOneTriangle) return hn::Set(d, table.field(field)[slots[i]]);
    return hn::GatherIndex(d, table.field(field), slot);
  };
  const auto b1 = hn::Load(d, block.b1 + i), b2 = hn::Load(d, block.b2 + i);
  const auto interpolate = [&](std::size_t field) HWY_ATTR {
    return hn::MulAdd(b2, read(field + 6), hn::MulAdd(b1, read(field + 3), read(field)));
  };
  const FrameVector normal{interpolate(kNormal0), interpolate(kNormal0 + 1),
                           interpolate(kNormal0 + 2)};
  const FrameVector tangent{interpolate(kTangent0), interpolate(kTangent0 + 1),
                            interpolate(kTangent0 + 2)};
  const auto mirrored = kOneTriangle ? hn::Set(du, table.mirrored[slots[i]])
                                     : hn::GatherIndex(du, table.mirrored, slot);
  hn::Vec<FrameU> frame0, frame1;
  packFrames(normal, tangent, mirrored, frame0, frame1);
  hn::Store(frame0, du, block.plane(Plane::kFrame0) + i);
  hn::Store(frame1, du, block.plane(Plane::kFrame1) + i);
  if (with_steps) storeNormalSteps(read, normal, i, block);
}

HWY_INLINE void evaluateFrames(const AttributeTable& table, const std::int32_t* slots,
                               std::size_t count, bool with_steps, Block& block) {
  const FrameI di;
  for (std::size_t i = 0; i < count; i += hn::Lanes(di)) {
    if (allSame(hn::LoadU(di, slots + i), slots[i]))
      packVector<true>(table, slots, i, with_steps, block);
    else
      packVector<false>(table, slots, i, with_steps, block);
  }
}

// Copies a block to its plane. Whole blocks are aligned there and bypass the cache: planes are
// larger than the cache, and what is written in full need not be read first.
HWY_INLINE void copyBlock(const std::uint32_t* HWY_RESTRICT from, std::size_t count,
                          std::uint32_t* HWY_RESTRICT to) {
  const FrameU du;
  if (count != kBlock) {
    std::copy(from, from + count, to);
    return;
  }
  for (std::size_t i = 0; i < kBlock; i += hn::Lanes(du))
    hn::Stream(hn::LoadU(du, from + i), du, to + i);
}

void writeAll(const AttributeTable& table, const TilePixels& pixels, std::uint32_t first,
              std::uint32_t count, std::size_t entry, const PixelPlanes& out) {
  const bool with_steps = out.mask.hasAnyOf(kNormalSteps);
  const bool with_frame = out.mask.hasAnyOf(kFramePlanes);
  const bool with_attributes = !(out.mask == PlaneMask{Plane::kPixel});
  Block block;
  std::size_t n = 0;
  for (std::size_t done = 0; done < count; done += n) {
    // The first block is short where that aligns the others.
    n = std::min<std::size_t>(kBlock - (entry + done) % kBlock, count - done);
    const std::uint32_t* pixel = pixels.pixels + first + done;
    const auto* slots = reinterpret_cast<const std::int32_t*>(pixels.slots + first + done);
    if (with_attributes)
      evaluateBarycentrics(table, slots, reinterpret_cast<const std::int32_t*>(pixel), n, out.mask,
                           block);
    if (with_frame) evaluateFrames(table, slots, n, with_steps, block);

    for (std::size_t p = 0; p < kPlaneCount; ++p) {
      const auto plane = static_cast<Plane>(p);
      if (!out.mask.has(plane)) continue;
      const std::uint32_t* from = plane == Plane::kPixel ? pixel : block.planes[p];
      copyBlock(from, n, out.plane(plane).data() + entry + done);
    }
  }
  hwy::FlushStream();
}

}  // namespace glintmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glintmark {

HWY_EXPORT(writeAll);

void writeAttributes(const AttributeTable& table, const TilePixels& pixels, std::uint32_t first,
                     std::uint32_t count, std::size_t entry, const PixelPlanes& out) {
  HWY_DYNAMIC_DISPATCH(writeAll)(table, pixels, first, count, entry, out);
}

}  // namespace glintmark
#endif
