#include "host/raster/transform.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "host/raster/transform.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glintmark::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::ScalableTag<double>;
using F32 = hn::Rebind<float, F64>;
using I32 = hn::Rebind<std::int32_t, F64>;

template <class V>
HWY_INLINE V dotRow(const glm::dvec3& row, V x, V y, V z) {
  const F64 d;
  return hn::Add(hn::Add(hn::Mul(hn::Set(d, row.x), x), hn::Mul(hn::Set(d, row.y), y)),
                 hn::Mul(hn::Set(d, row.z), z));
}

// One batch of Lanes(F64) vertices; `xyz` has room for a full batch.
HWY_INLINE void transformBatch(const Projection& p, const float* HWY_RESTRICT xyz,
                               std::int32_t* HWY_RESTRICT out) {
  const F64 d;
  const F32 df;
  const I32 di;
  HWY_ALIGN float x_lanes[hn::MaxLanes(d)], y_lanes[hn::MaxLanes(d)], z_lanes[hn::MaxLanes(d)];
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) {
    x_lanes[i] = xyz[3 * i];
    y_lanes[i] = xyz[3 * i + 1];
    z_lanes[i] = xyz[3 * i + 2];
  }
  const auto x = hn::Sub(hn::PromoteTo(d, hn::Load(df, x_lanes)), hn::Set(d, p.eye.x));
  const auto y = hn::Sub(hn::PromoteTo(d, hn::Load(df, y_lanes)), hn::Set(d, p.eye.y));
  const auto z = hn::Sub(hn::PromoteTo(d, hn::Load(df, z_lanes)), hn::Set(d, p.eye.z));
  const auto w = dotRow(p.row_w, x, y, z);
  const auto inverse_w = hn::Div(hn::Set(d, 1.0), w);
  const auto sx = hn::Round(hn::Mul(dotRow(p.row_x, x, y, z), inverse_w));
  const auto sy = hn::Round(hn::Mul(dotRow(p.row_y, x, y, z), inverse_w));

  // Written so that NaN fails.
  const auto guard = hn::Set(d, static_cast<double>(kGuardBand));
  const auto inside = hn::And(hn::Ge(w, hn::Set(d, p.near_plane)),
                              hn::And(hn::Le(hn::Abs(sx), guard), hn::Le(hn::Abs(sy), guard)));
  const auto flagged_x =
      hn::IfThenElse(inside, sx, hn::Set(d, static_cast<double>(kNeedsClipping)));
  const auto zero = hn::Zero(d);

  hn::StoreInterleaved4(hn::DemoteTo(di, flagged_x),
                        hn::DemoteTo(di, hn::IfThenElse(inside, sy, zero)),
                        hn::BitCast(di, hn::DemoteTo(df, hn::IfThenElse(inside, inverse_w, zero))),
                        hn::Zero(di), di, out);
}

void transformAll(const Projection& p, const float* HWY_RESTRICT xyz, std::size_t count,
                  ScreenVertex* HWY_RESTRICT out) {
  constexpr std::size_t kMax = hn::MaxLanes(F64());
  const std::size_t lanes = hn::Lanes(F64());
  std::size_t i = 0;
  for (; i + lanes <= count; i += lanes)
    transformBatch(p, xyz + 3 * i, reinterpret_cast<std::int32_t*>(out + i));
  if (i == count) return;

  float tail[3 * kMax] = {};
  ScreenVertex result[kMax];
  std::copy(xyz + 3 * i, xyz + 3 * count, tail);
  transformBatch(p, tail, reinterpret_cast<std::int32_t*>(result));
  std::copy(result, result + (count - i), out + i);
}

}  // namespace glintmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glintmark {

HWY_EXPORT(transformAll);

void transformVertices(const Projection& projection, std::span<const glm::vec3> positions,
                       std::span<ScreenVertex> out) {
  static_assert(sizeof(glm::vec3) == 12 && sizeof(ScreenVertex) == 16);
  HWY_DYNAMIC_DISPATCH(transformAll)
  (projection, reinterpret_cast<const float*>(positions.data()), positions.size(), out.data());
}

}  // namespace glintmark
#endif
