// Runs the shading of lobes of any covariance over arrays. Compiled with -D DIFFUSE=1.
#include "normals/covariance_lobe.clh"

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

// in: planes of `count` entries: moments of a lobe (weight, x, y, xx, xy, yy), light (3), view (3),
// all mesh tangent space. out: specular, cosine.
WIDE_KERNEL void probeCovariance(global const float* in, global float* out, uint count,
                                 float alpha) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
#define IN(plane) loadFloat(in, (size_t)(plane)*count + i)
  const CovarianceLobe moments = {IN(0), IN(1), IN(2), IN(3), IN(4), IN(5)};
  const vfloat3 light = {IN(6), IN(7), IN(8)}, view = {IN(9), IN(10), IN(11)};
#undef IN
  const MethodLobe shape = shapeCovarianceLobe(covarianceOf(moments), alpha * alpha);
  const LobeLight shaded = shadeLobe(&shape, lightGeometry(light, view), alpha);
  storeFloat(shaded.specular, out, i);
  storeFloat(shaded.cosine, out, count + i);
}
