// Lights hand-made mixtures of normals. Compiled with -D NORMAL_MAP=1 -D LTC=1 -D LTC_METHOD=3.
#include "area/area_mixture.clh"

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

// points: planes of `count` entries: position (3) and view (3), both on a mesh whose frame is that
// of the world, then four moments of each lobe. table: that of the base lobe and that of normals.
// out: r, g, b.
WIDE_KERNEL void probeAreaMixture(global const float* points,
                                  constant const MaterialParams* material,
                                  constant const AreaLightParams* lights, global const float* table,
                                  global float* out, uint light_count, uint table_size,
                                  uint count) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
#define IN(plane) loadFloat(points, (size_t)(plane)*count + i)
  LitPoint point;
  point.position.x = IN(0), point.position.y = IN(1), point.position.z = IN(2);
  point.view.x = IN(3), point.view.y = IN(4), point.view.z = IN(5);
  const float alpha_sq = material->surface.alpha_g.x * material->surface.alpha_g.y;
  point.alpha = (vfloat)(sqrt(alpha_sq));
  vfloat4 moments[LOBES];
  for (int k = 0; k < LOBES; ++k) {
    moments[k].x = IN(6 + 4 * k), moments[k].y = IN(7 + 4 * k);
    moments[k].z = IN(8 + 4 * k), moments[k].w = IN(9 + 4 * k);
  }
#undef IN
  ShadingFrame basis;
  basis.tangent = broadcast3((float4)(1.0f, 0.0f, 0.0f, 0.0f));
  basis.bitangent = broadcast3((float4)(0.0f, 1.0f, 0.0f, 0.0f));
  basis.normal = point.normal = broadcast3((float4)(0.0f, 0.0f, 1.0f, 0.0f));
  point.variance = (vfloat)(0.0f);
  MixedLobe lobes[LOBES];
  const int used = mixtureLobes(moments, pooledLobe(sumOfMoments(moments), (vfloat)(1.0f)),
                                (vfloat)(1.0f), alpha_sq, lobes);
  const vfloat3 sum = shadeAreaMixture(point, basis, lobes, used, &material->surface, lights,
                                       light_count, table, table_size);
  storeFloat(sum.x, out, i);
  storeFloat(sum.y, out, count + i);
  storeFloat(sum.z, out, 2 * count + i);
}
