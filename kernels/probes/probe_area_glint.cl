// Runs the share of microdetails that mirror an area light over hand-made points. Compiled with -D
// LTC=1 -D AREA_GLINTS=1.
#include "area/area_light.clh"

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

// points: planes of `count` entries: position (3), view (3, unit, z > 0); the surface's frame is
// the axes of the world. out: probability, what the lobe reflects, half vector (2) as
// microdetailRatio reads it.
WIDE_KERNEL void probeAreaGlint(global const float* points, constant const MaterialParams* material,
                                constant const AreaLightParams* light, global const float* table,
                                global float* out, uint table_size, uint count) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
#define IN(plane) loadFloat(points, (size_t)(plane)*count + i)
  const vfloat3 position = {IN(0), IN(1), IN(2)}, view = {IN(3), IN(4), IN(5)};
#undef IN
  const vfloat zero = (vfloat)(0.0f), one = (vfloat)(1.0f);
  const ShadingFrame basis = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  const ShadingFrame frame = viewFrame(basis.normal, view);
  const GlintView seen_by = glintView(frame, basis, view, material);
  const LtcLobe lobe = lookUpLtc(table, table_size, (vfloat)(seen_by.alpha), view.z, seen_by.sine);
  SeenLight seen = seeLight(light, frame, position);
  const SlopeRegion region = slopeRegion(&seen.outline, &seen_by);
  vfloat heights[LIGHT_VERTICES];
  transformLight(lobe, &seen, heights);
  const LobeShare share = cosineShare(&seen, heights, litSide(light, position));
  const LightLobe result =
      areaLightLobe(&region, lobe, share.factor, lobe.scale * share.value, &seen_by, material);
  storeFloat(result.probability, out, i);
  storeFloat(lobe.scale * share.value, out, count + i);
  storeFloat(result.half_u, out, 2 * (size_t)count + i);
  storeFloat(result.half_v, out, 3 * (size_t)count + i);
}
