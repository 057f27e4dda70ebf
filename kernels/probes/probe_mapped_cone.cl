// Runs one lobe of mapped normals under cones of light over arrays. Compiled with -D LIGHT_CONE=1
// -D NORMAL_MAP=1 -D LOBES=1 -D DIFFUSE=1.
#include "normals/method_gmm.clh"
#include "normals/normal_cone_template.clh"

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

// in: planes of `count` entries: light (3), view (3), mean normal (3), all mesh tangent space and
// unit, view.z > 0. out: specular, schlick, cosine. variance: of the normals, per axis.
WIDE_KERNEL void probeMappedCone(global const float* in, global float* out, uint count,
                                 constant const LightParams* light, float alpha, float variance) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
#define IN(plane) loadFloat(in, (size_t)(plane)*count + i)
  const vfloat3 axis = {IN(0), IN(1), IN(2)}, view = {IN(3), IN(4), IN(5)};
  const NormalLobe normals = {(vfloat)(1.0f), {IN(6), IN(7), IN(8)}, (vfloat)(variance)};
#undef IN
  const MethodLobe one = shapeMixedLobe(normals, view, (vfloat)(alpha * alpha));
  LightLobe lobe;
  lobe.specular = lobe.schlick = lobe.cosine = (vfloat)(0.0f);
  addMappedCone(&one, axis, view, alpha, light, &lobe);
  storeFloat(lobe.specular, out, i);
  storeFloat(lobe.schlick, out, count + i);
  storeFloat(lobe.cosine, out, 2 * count + i);
}
