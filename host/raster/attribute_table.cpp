#include "host/raster/attribute_table.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "host/raster/attribute_table.cpp"
#include <hwy/cache_control.h>
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace glintmark::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::ScalableTag<double>;
using I64 = hn::RebindToSigned<F64>;
using F32 = hn::Rebind<float, F64>;
using I32 = hn::Rebind<std::int32_t, F64>;
using VD = hn::Vec<F64>;
using VF = hn::Vec<F32>;
using VI = hn::Vec<I32>;

struct Vector3 {
  VD x, y, z;
};

HWY_INLINE Vector3 minus(const Vector3& a, const Vector3& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}

HWY_INLINE Vector3 cross(const Vector3& a, const Vector3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}

HWY_INLINE VD dot(const Vector3& a, const Vector3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

HWY_INLINE Vector3 uniform(const glm::dvec3& v) {
  const F64 d;
  return {hn::Set(d, v.x), hn::Set(d, v.y), hn::Set(d, v.z)};
}

HWY_INLINE Vector3 gatherPosition(const float* positions, VI vertex) {
  const F64 d;
  const F32 df;
  const VI at = hn::Add(hn::Add(vertex, vertex), vertex);
  return {hn::PromoteTo(d, hn::GatherIndex(df, positions, at)),
          hn::PromoteTo(d, hn::GatherIndex(df, positions + 1, at)),
          hn::PromoteTo(d, hn::GatherIndex(df, positions + 2, at))};
}

// Value at pixel (0, 0) and its change per pixel of dot(ray, n) * scale.
HWY_INLINE void storeLinear(const Camera& camera, const Vector3& n, VD scale, DoubleField f,
                            std::size_t slot, AttributeTable& table) {
  const F64 d;
  hn::StoreU(hn::Mul(dot(uniform(camera.ray_origin), n), scale), d, table.field(f) + slot);
  hn::StoreU(hn::Mul(dot(uniform(camera.ray_dx), n), scale), d,
             table.field(static_cast<DoubleField>(f + 1)) + slot);
  hn::StoreU(hn::Mul(dot(uniform(camera.ray_dy), n), scale), d,
             table.field(static_cast<DoubleField>(f + 2)) + slot);
}

// Ray-plane terms. Returns det, whose sign tells the side of the triangle that is seen.
HWY_INLINE VD setUpPlanes(const TriangleMesh& mesh, const Camera& camera, const VI (&v)[3],
                          std::size_t slot, AttributeTable& table) {
  const F64 d;
  const auto* positions = reinterpret_cast<const float*>(mesh.positions.data());
  const Vector3 eye = uniform(camera.eye), forward = uniform(camera.forward);
  const Vector3 a = gatherPosition(positions, v[0]), b = gatherPosition(positions, v[1]),
                c = gatherPosition(positions, v[2]);
  const Vector3 p0 = minus(a, eye), e1 = minus(b, a), e2 = minus(c, a);
  const Vector3 normal = cross(e1, e2);
  const VD det = dot(p0, normal);
  // The eye in the triangle's plane: only rounding to sub-pixels shows such a triangle. All terms
  // become zero, which yields the attributes of corner 0.
  const auto usable = hn::Gt(hn::Abs(det), hn::Set(d, 1e-280));
  const VD scale = hn::IfThenElseZero(usable, hn::Div(hn::Set(d, 1.0), det));
  storeLinear(camera, normal, scale, kQ, slot, table);
  storeLinear(camera, cross(e2, p0), scale, kG1, slot, table);
  storeLinear(camera, cross(p0, e1), scale, kG2, slot, table);

  const VD w0 = dot(p0, forward), w1 = hn::Add(w0, dot(e1, forward)),
           w2 = hn::Add(w0, dot(e2, forward));
  const VD farthest = hn::Max(hn::Max(hn::Max(w0, w1), w2), hn::Set(d, camera.near_plane));
  // A hair farther, so that rounding never pulls a ray through the corner itself.
  hn::StoreU(hn::Div(hn::Set(d, 1.0 - 1e-12), farthest), d, table.field(kQMin) + slot);
  return det;
}

HWY_INLINE void setUpUvs(const TriangleMesh& mesh, const VI (&v)[3], std::size_t slot,
                         AttributeTable& table) {
  const F64 d;
  const I64 di64;
  const auto* uvs = reinterpret_cast<const double*>(mesh.uvs.data());
  VD u[3], w[3];
  for (int i = 0; i < 3; ++i) {
    const auto at = hn::ShiftLeft<1>(hn::PromoteTo(di64, v[i]));
    u[i] = hn::GatherIndex(d, uvs, at);
    w[i] = hn::GatherIndex(d, uvs + 1, at);
  }
  hn::StoreU(u[0], d, table.field(kU0) + slot);
  hn::StoreU(w[0], d, table.field(kV0) + slot);
  hn::StoreU(hn::Sub(u[1], u[0]), d, table.field(kDu1) + slot);
  hn::StoreU(hn::Sub(w[1], w[0]), d, table.field(kDv1) + slot);
  hn::StoreU(hn::Sub(u[2], u[0]), d, table.field(kDu2) + slot);
  hn::StoreU(hn::Sub(w[2], w[0]), d, table.field(kDv2) + slot);
}

// Three components of a per-vertex vector: corner 0 and differences to it, times `sign`.
HWY_INLINE void setUpVectors(const float* base, const VI (&at)[3], VF sign, std::size_t field,
                             std::size_t slot, AttributeTable& table) {
  const F32 df;
  for (std::size_t component = 0; component < 3; ++component) {
    VF value[3];
    for (int i = 0; i < 3; ++i)
      value[i] = hn::Mul(hn::GatherIndex(df, base + component, at[i]), sign);
    hn::StoreU(value[0], df, table.field(field + component) + slot);
    hn::StoreU(hn::Sub(value[1], value[0]), df, table.field(field + 3 + component) + slot);
    hn::StoreU(hn::Sub(value[2], value[0]), df, table.field(field + 6 + component) + slot);
  }
}

HWY_INLINE void setUpFrame(const TriangleMesh& mesh, const VI (&v)[3], VD det, std::size_t slot,
                           AttributeTable& table) {
  const F64 d;
  const F32 df;
  const I32 di;
  // det > 0: the normal of the winding points away from the eye.
  const VF facing =
      hn::DemoteTo(df, hn::IfThenElse(hn::Gt(det, hn::Zero(d)), hn::Set(d, -1.0), hn::Set(d, 1.0)));
  VI at3[3], at4[3];
  for (int i = 0; i < 3; ++i) {
    at3[i] = hn::Add(hn::Add(v[i], v[i]), v[i]);
    at4[i] = hn::ShiftLeft<2>(v[i]);
  }
  const auto* tangents = reinterpret_cast<const float*>(mesh.tangents.data());
  setUpVectors(reinterpret_cast<const float*>(mesh.normals.data()), at3, facing, kNormal0, slot,
               table);
  setUpVectors(tangents, at4, hn::Set(df, 1.0f), kTangent0, slot, table);

  const VF handedness = hn::Mul(hn::GatherIndex(df, tangents + 3, at4[0]), facing);
  const auto mirrored = hn::RebindMask(di, hn::Lt(handedness, hn::Zero(df)));
  hn::StoreU(hn::IfThenElseZero(mirrored, hn::Set(di, std::numeric_limits<std::int32_t>::min())),
             di, reinterpret_cast<std::int32_t*>(table.mirrored) + slot);
}

// Asks the cache for the corners of triangles [first, last).
HWY_INLINE void prefetchVertices(const TriangleMesh& mesh,
                                 const std::uint32_t* HWY_RESTRICT triangles, std::size_t first,
                                 std::size_t last, bool with_frame) {
  for (std::size_t i = first; i < last; ++i) {
    const glm::uvec3& t = mesh.triangles[triangles[i]];
    for (int corner = 0; corner < 3; ++corner) {
      hwy::Prefetch(&mesh.positions[t[corner]]);
      hwy::Prefetch(&mesh.uvs[t[corner]]);
      if (!with_frame) continue;
      hwy::Prefetch(&mesh.normals[t[corner]]);
      hwy::Prefetch(&mesh.tangents[t[corner]]);
    }
  }
}

void setUpAll(const TriangleMesh& mesh, const Camera& camera,
              const std::uint32_t* HWY_RESTRICT triangles, std::size_t count, bool with_frame,
              AttributeTable& table) {
  const I32 di;
  const auto* indices = reinterpret_cast<const std::int32_t*>(mesh.triangles.data());
  const std::size_t ahead = 2 * hn::Lanes(di);
  prefetchVertices(mesh, triangles, 0, std::min(count, ahead), with_frame);
  for (std::size_t slot = 0; slot < count; slot += hn::Lanes(di)) {
    prefetchVertices(mesh, triangles, slot + ahead, std::min(count, slot + ahead + hn::Lanes(di)),
                     with_frame);
    const VI t = hn::LoadU(di, reinterpret_cast<const std::int32_t*>(triangles) + slot);
    const VI at = hn::Add(hn::Add(t, t), t);
    const VI v[3] = {hn::GatherIndex(di, indices, at), hn::GatherIndex(di, indices + 1, at),
                     hn::GatherIndex(di, indices + 2, at)};
    const VD det = setUpPlanes(mesh, camera, v, slot, table);
    setUpUvs(mesh, v, slot, table);
    if (with_frame) setUpFrame(mesh, v, det, slot, table);
  }
}

}  // namespace glintmark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace glintmark {

HWY_EXPORT(setUpAll);

void setUpAttributes(const TriangleMesh& mesh, const Camera& camera, const std::uint32_t* triangles,
                     std::size_t count, bool with_frame, AttributeTable& table) {
  static_assert(sizeof(glm::vec4) == 16 && sizeof(glm::dvec2) == 16 && sizeof(glm::uvec3) == 12);
  HWY_DYNAMIC_DISPATCH(setUpAll)(mesh, camera, triangles, count, with_frame, table);
}

}  // namespace glintmark
#endif
