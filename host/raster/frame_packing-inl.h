// SIMD form of packFrame (host/core/frame_packing.h) in single precision. Included once per SIMD
// target; quantized values may differ from the scalar reference by one unit.
#if defined(GLINTMARK_FRAME_PACKING_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GLINTMARK_FRAME_PACKING_INL
#undef GLINTMARK_FRAME_PACKING_INL
#else
#define GLINTMARK_FRAME_PACKING_INL
#endif

#include <hwy/highway.h>

#include "host/core/frame_packing.h"

HWY_BEFORE_NAMESPACE();
namespace glintmark::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FrameF = hn::ScalableTag<float>;
using FrameI = hn::ScalableTag<std::int32_t>;
using FrameU = hn::ScalableTag<std::uint32_t>;

struct FrameVector {
  hn::Vec<FrameF> x, y, z;
};

// [-1, 1] to integers [-kFrameScale, kFrameScale].
HWY_INLINE hn::Vec<FrameI> quantizeFrame(hn::Vec<FrameF> value) {
  return hn::NearestInt(hn::Mul(value, hn::Set(FrameF(), static_cast<float>(kFrameScale))));
}

// Unit vector of quantized octahedral coordinates.
HWY_INLINE FrameVector decodeOctahedral(hn::Vec<FrameI> qx, hn::Vec<FrameI> qy) {
  const FrameF d;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f);
  const auto scale = hn::Set(d, 1.0f / static_cast<float>(kFrameScale));
  const auto ox = hn::Mul(hn::ConvertTo(d, qx), scale), oy = hn::Mul(hn::ConvertTo(d, qy), scale);
  // From whole numbers, because 1 - |ox| - |oy| in floats loses what is left near the equator.
  const FrameI di;
  const auto qz = hn::Sub(hn::Sub(hn::Set(di, kFrameScale), hn::Abs(qx)), hn::Abs(qy));
  const auto z = hn::Mul(hn::ConvertTo(d, qz), scale);
  const auto lower = hn::Lt(z, zero);
  const auto x = hn::IfThenElse(
      lower, hn::CopySign(hn::Sub(one, hn::Abs(oy)), hn::IfThenElse(hn::Lt(ox, zero), ox, one)),
      ox);
  const auto y = hn::IfThenElse(
      lower, hn::CopySign(hn::Sub(one, hn::Abs(ox)), hn::IfThenElse(hn::Lt(oy, zero), oy, one)),
      oy);
  const auto squared = hn::Add(hn::Add(hn::Mul(x, x), hn::Mul(y, y)), hn::Mul(z, z));
  const auto inverse = hn::Div(one, hn::Sqrt(squared));
  return {hn::Mul(x, inverse), hn::Mul(y, inverse), hn::Mul(z, inverse)};
}

// Packs a normal (need not be unit; where it is zero or not a number, +z is packed) and a tangent.
// `mirrored` has bit 31 set for left-handed frames and no other.
HWY_INLINE void packFrames(const FrameVector& normal, const FrameVector& tangent,
                           hn::Vec<FrameU> mirrored, hn::Vec<FrameU>& frame0,
                           hn::Vec<FrameU>& frame1) {
  const FrameF d;
  const FrameI di;
  const FrameU du;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), minus_one = hn::Set(d, -1.0f);
  const auto sum = hn::Add(hn::Add(hn::Abs(normal.x), hn::Abs(normal.y)), hn::Abs(normal.z));
  const auto usable = hn::And(hn::Gt(sum, zero), hn::Lt(sum, hn::Set(d, 1e38f)));
  const auto inverse = hn::IfThenElseZero(usable, hn::Div(one, sum));
  const auto nx = hn::IfThenElseZero(usable, hn::Mul(normal.x, inverse));
  const auto ny = hn::IfThenElseZero(usable, hn::Mul(normal.y, inverse));
  const auto lower = hn::And(usable, hn::Lt(normal.z, zero));
  const auto sign_x = hn::IfThenElse(hn::Lt(nx, zero), minus_one, one);
  const auto sign_y = hn::IfThenElse(hn::Lt(ny, zero), minus_one, one);
  const auto qx =
      quantizeFrame(hn::IfThenElse(lower, hn::Mul(hn::Sub(one, hn::Abs(ny)), sign_x), nx));
  const auto qy =
      quantizeFrame(hn::IfThenElse(lower, hn::Mul(hn::Sub(one, hn::Abs(nx)), sign_y), ny));

  // Duff et al. 2017, Listing 3, on the decoded normal.
  const FrameVector n = decodeOctahedral(qx, qy);
  const auto sign = hn::IfThenElse(hn::Lt(n.z, zero), minus_one, one);
  const auto a = hn::Div(minus_one, hn::Add(sign, n.z));
  const auto b = hn::Mul(hn::Mul(n.x, n.y), a);
  const FrameVector b1{hn::Add(one, hn::Mul(sign, hn::Mul(hn::Mul(n.x, n.x), a))), hn::Mul(sign, b),
                       hn::Neg(hn::Mul(sign, n.x))};
  const FrameVector b2{b, hn::Add(sign, hn::Mul(hn::Mul(n.y, n.y), a)), hn::Neg(n.y)};
  const auto dot = [](const FrameVector& p, const FrameVector& q) HWY_ATTR {
    return hn::Add(hn::Add(hn::Mul(p.x, q.x), hn::Mul(p.y, q.y)), hn::Mul(p.z, q.z));
  };
  const auto c = dot(tangent, b1), s = dot(tangent, b2);

  // Diamond angle.
  const auto length = hn::Add(hn::Abs(c), hn::Abs(s));
  const auto has_direction = hn::And(hn::Gt(length, zero), hn::Lt(length, hn::Set(d, 1e38f)));
  const auto p = hn::IfThenElse(has_direction, hn::Div(c, length), one);
  const auto angle = hn::CopySign(hn::Mul(hn::Set(d, 0.5f), hn::Sub(one, p)), s);

  const auto offset = hn::Set(di, kFrameScale);
  const auto ux = hn::BitCast(du, hn::Add(qx, offset)), uy = hn::BitCast(du, hn::Add(qy, offset));
  const auto ua = hn::BitCast(du, hn::Add(quantizeFrame(angle), offset));
  frame0 = hn::Or(ux, hn::ShiftLeft<21>(ua));
  frame1 = hn::Or3(uy, hn::ShiftLeft<21>(hn::ShiftRight<11>(ua)), mirrored);
}

}  // namespace glintmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
