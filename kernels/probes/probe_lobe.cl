// Runs the shading of lobes over arrays. Compiled with -D DIFFUSE=1.
#include "normals/method_gmm.clh"

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

// in: planes of `count` entries: moments (4), light (3), view (3), all mesh tangent space.
// out: lobe weight, mean x, mean y, variance, specular, cosine.
WIDE_KERNEL void probeLobe(global const float* in, global float* out, uint count, float alpha) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
#define IN(plane) loadFloat(in, (size_t)(plane)*count + i)
  const vfloat4 moments = {IN(0), IN(1), IN(2), IN(3)};
  const vfloat3 light = {IN(4), IN(5), IN(6)}, view = {IN(7), IN(8), IN(9)};
#undef IN
  const NormalLobe lobe = liftedLobe(lobeFromMoments(moments));
  const LobeShape shape = shapeMixedLobe(lobe, view, (vfloat)(alpha * alpha));
  const LobeLight shaded = evaluateShape(&shape, lightGeometry(light, view), alpha);
  storeFloat(lobe.weight, out, i);
  storeFloat(lobe.normal.x, out, count + i);
  storeFloat(lobe.normal.y, out, 2 * count + i);
  storeFloat(lobe.variance, out, 3 * count + i);
  storeFloat(shaded.specular, out, 4 * count + i);
  storeFloat(shaded.cosine, out, 5 * count + i);
}

#if LOBES > 1
// in: planes of `count` entries, four moments of each lobe. out: how many lobes some lane has, then
// weight, mean x, mean y, variance of each lobe, 0 for those that are not in use. true_spread: of
// the probes that read the moments.
WIDE_KERNEL void probeMixture(global const float* in, global float* out, uint count, float alpha,
                              float true_spread) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
  vfloat4 moments[LOBES];
  for (int k = 0; k < LOBES; ++k) {
    const size_t plane = 4 * (size_t)k * count + i;
    moments[k].x = loadFloat(in, plane);
    moments[k].y = loadFloat(in, plane + count);
    moments[k].z = loadFloat(in, plane + 2 * (size_t)count);
    moments[k].w = loadFloat(in, plane + 3 * (size_t)count);
  }
  MixedLobe lobes[LOBES];
  const int used = mixtureLobes(moments, pooledLobe(sumOfMoments(moments), (vfloat)(true_spread)),
                                (vfloat)(true_spread), alpha * alpha, lobes);
  storeFloat((vfloat)((float)used), out, i);
  for (int k = 0; k < LOBES; ++k) {
    const float on = k < used ? 1.0f : 0.0f;
    const size_t plane = (4 * (size_t)k + 1) * count + i;
    storeFloat(on * lobes[k].weight, out, plane);
    storeFloat(on * lobes[k].x, out, plane + count);
    storeFloat(on * lobes[k].y, out, plane + 2 * (size_t)count);
    storeFloat(on * lobes[k].variance, out, plane + 3 * (size_t)count);
  }
}
#endif
