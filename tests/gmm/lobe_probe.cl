// Runs the shading of lobes over arrays. Compiled with -D DIFFUSE=1.
#include "normal_filter.clh"

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

// in: planes of `count` entries: moments (4), light (3), view (3), all mesh tangent space.
// out: lobe weight, mean x, mean y, variance, specular, cosine.
kernel void probeLobe(global const float* in, global float* out, uint count, float alpha) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
#define IN(plane) loadFloat(in, (size_t)(plane)*count + i)
  const vfloat4 moments = {IN(0), IN(1), IN(2), IN(3)};
  const vfloat3 light = {IN(4), IN(5), IN(6)}, view = {IN(7), IN(8), IN(9)};
#undef IN
  const NormalLobe lobe = liftedLobe(lobeFromMoments(moments));
  const LobeShape shape = shapeLobe(lobe, view, (vfloat)(alpha * alpha));
  const LobeLight shaded = evaluateShape(&shape, lightGeometry(light, view), alpha);
  storeFloat(lobe.weight, out, i);
  storeFloat(lobe.normal.x, out, count + i);
  storeFloat(lobe.normal.y, out, 2 * count + i);
  storeFloat(lobe.variance, out, 3 * count + i);
  storeFloat(shaded.specular, out, 4 * count + i);
  storeFloat(shaded.cosine, out, 5 * count + i);
}
