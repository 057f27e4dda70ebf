// Runs the smooth lobe under cones of light over arrays. Compiled with -D LIGHT_CONE=1.
#include "glint/glint.clh"

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

// in: planes of `count` entries: light (3), view (3), both local frame and unit, view.z > 0.
// out: specular, schlick, cosine, probability, side of a half-vector cell along u.
WIDE_KERNEL void probeCone(global const float* in, global float* out, uint count,
                           constant const MaterialParams* material,
                           constant const LightParams* light) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
#define IN(plane) loadFloat(in, (size_t)(plane)*count + i)
  const vfloat3 axis = {IN(0), IN(1), IN(2)}, view = {IN(3), IN(4), IN(5)};
#undef IN
  const SurfaceAlpha alpha = surfaceAlpha(material->surface.alpha_g);
  const LightLobe lobe = coneLobe(axis, view, smithLambda(view, alpha), alpha, material, light);
  storeFloat(lobe.specular, out, i);
  storeFloat(lobe.schlick, out, count + i);
  storeFloat(lobe.cosine, out, 2 * count + i);
  storeFloat(lobe.probability, out, 3 * count + i);
  const vfloat cells = halfVectorCells(material->glints.alpha_l.x, (ConeSlope)(light->direction.w));
  storeFloat(1.0f / cells, out, 4 * count + i);
}
