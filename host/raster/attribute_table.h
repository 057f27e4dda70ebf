// What a pixel needs of its triangle, computed once per triangle seen in a tile.
//
// A ray d through pixel (x, y), with dot(d, forward) = 1, meets the plane of a triangle (p0, p0 +
// e1, p0 + e2; eye at the origin) at distance t and barycentrics b1, b2, where
//   q  = dot(d, e1 x e2)  / det = 1 / t        det = dot(p0, e1 x e2)
//   g1 = dot(d, e2 x p0)  / det = b1 / t
//   g2 = dot(d, p0 x e1)  / det = b2 / t
// As d is linear in x and y, so are q, g1 and g2: three numbers each. Nothing is clipped or divided
// by a vertex's own depth, so triangles through the eye plane need no care. The quotient rule gives
// the derivatives: db/dx = (dg/dx - b dq/dx) / q.
#pragma once
#include <cstdint>
#include <memory>

#include "host/raster/camera.h"
#include "host/raster/projection.h"
#include "host/scene/scene.h"

namespace glintmark {

enum DoubleField : std::size_t {
  kQ,
  kQdx,
  kQdy,
  kG1,
  kG1dx,
  kG1dy,
  kG2,
  kG2dx,
  kG2dy,
  kQMin,  // 1 / distance of the farthest corner, keeps rays that barely miss the triangle finite
  kU0,
  kV0,
  kDu1,
  kDv1,
  kDu2,
  kDv2,  // uv of corner 0, differences of the others to it
  kDoubleFields
};

enum FloatField : std::size_t {
  kNormal0,
  kNormalD1 = kNormal0 + 3,
  kNormalD2 = kNormalD1 + 3,
  kTangent0 = kNormalD2 + 3,
  kTangentD1 = kTangent0 + 3,
  kTangentD2 = kTangentD1 + 3,
  kFloatFields = kTangentD2 + 3
};

/// Structure of arrays over slots. Strides are no powers of two: fields of one slot would all fall
/// into the same few sets of the cache.
struct AttributeTable {
  static constexpr std::size_t kDoubleStride = kTilePixels + 24;
  static constexpr std::size_t kFloatStride = kTilePixels + 48;
  alignas(64) double doubles[kDoubleFields * kDoubleStride];
  alignas(64) float floats[kFloatFields * kFloatStride];
  alignas(64) std::uint32_t mirrored[kFloatStride];  // bit 31: the frame is left-handed

  double* field(DoubleField f) { return doubles + f * kDoubleStride; }
  const double* field(DoubleField f) const { return doubles + f * kDoubleStride; }
  float* field(std::size_t float_field) { return floats + float_field * kFloatStride; }
  const float* field(std::size_t float_field) const { return floats + float_field * kFloatStride; }
};

/// Fills slots [0, count) for `triangles`, which must have kListSlack readable entries more.
/// Normals of triangles that show their back are turned round and their handedness is toggled, so
/// that the bitangent stays as it is.
void setUpAttributes(const TriangleMesh& mesh, const Camera& camera, const std::uint32_t* triangles,
                     std::size_t count, bool with_frame, AttributeTable& table);

}  // namespace glintmark
