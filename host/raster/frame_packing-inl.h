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

// 1 / value to about single precision, for values and results that are normal numbers. Two steps of
// Newton's method: on some targets the estimate has no more than 8 bits.
HWY_INLINE hn::Vec<FrameF> reciprocal(hn::Vec<FrameF> value) {
  const auto two = hn::Set(FrameF(), 2.0f);
  auto r = hn::ApproximateReciprocal(value);
  r = hn::Mul(r, hn::NegMulAdd(value, r, two));
  return hn::Mul(r, hn::NegMulAdd(value, r, two));
}

// Square root of a normal number, to about single precision, in the same way.
HWY_INLINE hn::Vec<FrameF> squareRoot(hn::Vec<FrameF> value) {
  const auto three_halves = hn::Set(FrameF(), 1.5f);
  const auto half = hn::Mul(value, hn::Set(FrameF(), 0.5f));
  auto r = hn::ApproximateReciprocalSqrt(value);
  r = hn::Mul(r, hn::NegMulAdd(half, hn::Mul(r, r), three_halves));
  r = hn::Mul(r, hn::NegMulAdd(half, hn::Mul(r, r), three_halves));
  return hn::Mul(value, r);
}

// Is a sum of magnitudes such that its reciprocal is a normal number?
HWY_INLINE auto isInvertible(hn::Vec<FrameF> sum) {
  const FrameF d;
  return hn::And(hn::Gt(sum, hn::Set(d, 1e-37f)), hn::Lt(sum, hn::Set(d, 1e37f)));
}

// [-1, 1] to integers [-kFrameScale, kFrameScale].
HWY_INLINE hn::Vec<FrameI> quantizeFrame(hn::Vec<FrameF> value) {
  return hn::NearestInt(hn::Mul(value, hn::Set(FrameF(), static_cast<float>(kFrameScale))));
}

// Direction of quantized octahedral coordinates, of length between kFrameScale / 2 and kFrameScale.
// All components are whole numbers, so decoding is exact.
HWY_INLINE FrameVector decodeOctahedral(hn::Vec<FrameI> qx, hn::Vec<FrameI> qy) {
  const FrameF d;
  const FrameI di;
  const auto scale = hn::Set(di, kFrameScale);
  const auto rest_x = hn::Sub(scale, hn::Abs(qx)), rest_y = hn::Sub(scale, hn::Abs(qy));
  const auto z = hn::Sub(rest_x, hn::Abs(qy));
  const auto lower = hn::Lt(z, hn::Zero(di));
  // Below the equator: 1 - |other|, with the sign of this one.
  const auto x = hn::IfThenElse(hn::Lt(qx, hn::Zero(di)), hn::Neg(rest_y), rest_y);
  const auto y = hn::IfThenElse(hn::Lt(qy, hn::Zero(di)), hn::Neg(rest_x), rest_x);
  return {hn::ConvertTo(d, hn::IfThenElse(lower, x, qx)),
          hn::ConvertTo(d, hn::IfThenElse(lower, y, qy)), hn::ConvertTo(d, z)};
}

// Sine and cosine of the tangent's angle, up to a common positive factor. With m = L n, s the sign
// of n.z and k = L + |m.z|, the basis of Duff et al. 2017, Listing 3, times L k is
//   b1 = (L k - m.x m.x,      -m.x m.y,  -s k m.x)
//   b2 = (    -s m.x m.y, s (L k - m.y m.y),   -k m.y)
// which needs no division.
HWY_INLINE void tangentAngle(const FrameVector& m, const FrameVector& t, hn::Vec<FrameF>& cosine,
                             hn::Vec<FrameF>& sine) {
  const FrameF d;
  const auto length = squareRoot(hn::MulAdd(m.x, m.x, hn::MulAdd(m.y, m.y, hn::Mul(m.z, m.z))));
  const auto k = hn::Add(length, hn::Abs(m.z));
  const auto scale = hn::Mul(length, k);
  const auto sign_bit = hn::And(m.z, hn::SignBit(d));
  const auto common =
      hn::MulAdd(m.x, t.x, hn::MulAdd(m.y, t.y, hn::Xor(hn::Mul(k, t.z), sign_bit)));
  cosine = hn::NegMulAdd(m.x, common, hn::Mul(t.x, scale));
  sine = hn::Xor(hn::NegMulAdd(m.y, common, hn::Mul(t.y, scale)), sign_bit);
}

// Packs a normal (need not be unit; where it is below 1e-37 or not a number, +z is packed) and a
// tangent. `mirrored` has bit 31 set for left-handed frames and no other.
HWY_INLINE void packFrames(const FrameVector& normal, const FrameVector& tangent,
                           hn::Vec<FrameU> mirrored, hn::Vec<FrameU>& frame0,
                           hn::Vec<FrameU>& frame1) {
  const FrameF d;
  const FrameI di;
  const FrameU du;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1.0f), minus_one = hn::Set(d, -1.0f);
  const auto sum = hn::Add(hn::Add(hn::Abs(normal.x), hn::Abs(normal.y)), hn::Abs(normal.z));
  const auto usable = isInvertible(sum);
  const auto inverse = reciprocal(sum);
  const auto nx = hn::IfThenElseZero(usable, hn::Mul(normal.x, inverse));
  const auto ny = hn::IfThenElseZero(usable, hn::Mul(normal.y, inverse));
  const auto lower = hn::And(usable, hn::Lt(normal.z, zero));
  const auto sign_x = hn::IfThenElse(hn::Lt(nx, zero), minus_one, one);
  const auto sign_y = hn::IfThenElse(hn::Lt(ny, zero), minus_one, one);
  const auto qx =
      quantizeFrame(hn::IfThenElse(lower, hn::Mul(hn::Sub(one, hn::Abs(ny)), sign_x), nx));
  const auto qy =
      quantizeFrame(hn::IfThenElse(lower, hn::Mul(hn::Sub(one, hn::Abs(nx)), sign_y), ny));

  hn::Vec<FrameF> c, s;
  tangentAngle(decodeOctahedral(qx, qy), tangent, c, s);

  // Diamond angle.
  const auto length = hn::Add(hn::Abs(c), hn::Abs(s));
  const auto p = hn::IfThenElse(isInvertible(length), hn::Mul(c, reciprocal(length)), one);
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
