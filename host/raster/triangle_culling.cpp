#include "host/raster/triangle_culling.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "host/raster/triangle_culling.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glintmark::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::ScalableTag<double>;
using I32 = hn::Rebind<std::int32_t, F64>;
using VI = hn::Vec<I32>;

// Twice the signed area; exact, because coordinates stay within the guard band.
HWY_INLINE hn::Vec<F64> signedArea(const VI (&x)[3], const VI (&y)[3]) {
  const F64 d;
  const auto dx1 = hn::PromoteTo(d, hn::Sub(x[1], x[0])),
             dy1 = hn::PromoteTo(d, hn::Sub(y[1], y[0]));
  const auto dx2 = hn::PromoteTo(d, hn::Sub(x[2], x[0])),
             dy2 = hn::PromoteTo(d, hn::Sub(y[2], y[0]));
  return hn::Sub(hn::Mul(dx1, dy2), hn::Mul(dx2, dy1));
}

// First and last pixel whose centre lies within [min, max] on one axis, cut to the image.
HWY_INLINE void pixelRange(const VI (&c)[3], std::int32_t origin, int size_px, VI& first,
                           VI& last) {
  const I32 di;
  const VI low = hn::Min(hn::Min(c[0], c[1]), c[2]), high = hn::Max(hn::Max(c[0], c[1]), c[2]);
  first = hn::Max(hn::ShiftRight<kSubpixelBits>(hn::Add(low, hn::Set(di, origin + kSubpixels - 1))),
                  hn::Zero(di));
  last = hn::Min(hn::ShiftRight<kSubpixelBits>(hn::Add(high, hn::Set(di, origin))),
                 hn::Set(di, size_px - 1));
}

HWY_INLINE void cullVector(const ProjectedMesh& mesh, VI vertex0, VI vertex1, VI vertex2,
                           std::size_t at, CullBatch& batch) {
  const I32 di;
  const F64 d;
  const auto* base = reinterpret_cast<const std::int32_t*>(mesh.vertices.data());
  const VI indices[3] = {hn::ShiftLeft<2>(vertex0), hn::ShiftLeft<2>(vertex1),
                         hn::ShiftLeft<2>(vertex2)};
  VI x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = hn::GatherIndex(di, base, indices[i]);
    y[i] = hn::GatherIndex(di, base + 1, indices[i]);
  }
  const VI needs_clipping = hn::Set(di, kNeedsClipping);
  const auto clip = hn::Or(hn::Eq(x[0], needs_clipping),
                           hn::Or(hn::Eq(x[1], needs_clipping), hn::Eq(x[2], needs_clipping)));

  const auto area = signedArea(x, y);
  // y points down: a triangle that is counter-clockwise to the eye has a negative area here.
  const auto shown = mesh.cull_back_faces ? hn::Lt(area, hn::Zero(d)) : hn::Ne(area, hn::Zero(d));
  const VI shown_i = hn::DemoteTo(di, hn::IfThenElseZero(shown, hn::Set(d, 1.0)));  // 1 where shown

  VI x0, y0, x1, y1;
  const Projection& p = *mesh.projection;
  pixelRange(x, p.origin_x, p.width_px, x0, x1);
  pixelRange(y, p.origin_y, p.height_px, y0, y1);
  const auto no_pixel = hn::Or(hn::Gt(x0, x1), hn::Gt(y0, y1));
  const VI visible = hn::IfThenZeroElse(no_pixel, shown_i);
  const VI result =
      hn::IfThenElse(clip, hn::Set(di, static_cast<std::int32_t>(CullResult::kClip)), visible);

  hn::StoreU(result, di, reinterpret_cast<std::int32_t*>(batch.result) + at);
  hn::StoreU(x0, di, batch.x0 + at);
  hn::StoreU(y0, di, batch.y0 + at);
  hn::StoreU(x1, di, batch.x1 + at);
  hn::StoreU(y1, di, batch.y1 + at);
}

void cullAll(const ProjectedMesh& mesh, std::size_t first, std::size_t count, CullBatch& batch) {
  const I32 di;
  const std::size_t lanes = hn::Lanes(di);
  const auto* indices = reinterpret_cast<const std::int32_t*>(mesh.mesh->triangles.data());
  HWY_ALIGN std::int32_t corners[3][kCullBatch];
  const std::size_t padded = (count + lanes - 1) / lanes * lanes;
  for (std::size_t i = 0; i < padded; ++i) {
    const std::size_t triangle = first + std::min(i, count - 1);
    for (std::size_t corner = 0; corner < 3; ++corner)
      corners[corner][i] = indices[3 * triangle + corner];
  }
  for (std::size_t i = 0; i < count; i += lanes)
    cullVector(mesh, hn::Load(di, corners[0] + i), hn::Load(di, corners[1] + i),
               hn::Load(di, corners[2] + i), i, batch);
}

}  // namespace glintmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glintmark {

HWY_EXPORT(cullAll);

void cullTriangles(const ProjectedMesh& mesh, std::size_t first, std::size_t count,
                   CullBatch& batch) {
  HWY_DYNAMIC_DISPATCH(cullAll)(mesh, first, count, batch);
}

}  // namespace glintmark
#endif
