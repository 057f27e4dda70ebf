// Runs the area-light functions over arrays of hand-made points, and single functions over values.
#include "area/area_light.clh"
#include "area/meso.clh"

#define FIRST (get_global_id(0) * WIDTH)

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

WIDE vfloat3 loadVector(global const float* p, size_t i, size_t stride) {
  const vfloat3 r = {loadFloat(p, i), loadFloat(p, stride + i), loadFloat(p, 2 * stride + i)};
  return r;
}

// points: fourteen planes of `count` entries: position, normal, view, alpha; of anisotropic lobes,
// whose alpha that is along an axis, alpha across it and the axis. out: r, g, b.
WIDE_KERNEL void probeAreaLights(global const float* points,
                                 constant const MaterialParams* material,
                                 constant const AreaLightParams* lights, global const float* table,
#if LIGHT_TEXTURE
                                 constant const MipTexture* pictures,
                                 global const float4* picture_texels,
#endif
                                 global float* out, uint light_count, uint table_size, uint count) {
  if (FIRST >= count) return;
  LitPoint point;
  point.position = loadVector(points, FIRST, count);
  point.normal = loadVector(points, 3 * count + FIRST, count);
  point.view = loadVector(points, 6 * count + FIRST, count);
  point.alpha = loadFloat(points, 9 * count + FIRST);
#if LTC_ANISOTROPIC
  point.stretched =
      anisotropicAlpha(loadVector(points, 11 * count + FIRST, count), point.normal, point.alpha,
                       loadFloat(points, 10 * count + FIRST), MIN_AREA_ALPHA);
#endif
  const vfloat3 sum = shadeAreaLights(point, &material->surface, lights, light_count, table,
                                      table_size PICTURE_ARGUMENTS);
  storeFloat(sum.x, out, FIRST);
  storeFloat(sum.y, out, count + FIRST);
  storeFloat(sum.z, out, 2 * count + FIRST);
}

// Overall roughness of alpha_mi `micro` and the mean lengths `in`.
WIDE_KERNEL void probeFootprintAlpha(global const float* in, global float* out, uint count,
                                     float micro) {
  if (FIRST >= count) return;
  storeFloat(footprintAlpha(micro, loadFloat(in, FIRST)), out, FIRST);
}
