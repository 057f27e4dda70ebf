// Runs the kernels' binomial draw over arrays of (random bits, n, p).
#include "glint/glint.clh"

#define FIRST (get_global_id(0) * WIDTH)

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

WIDE_KERNEL void probeBinomial(global const uint* bits, global const float* n,
                               global const float* p, global float* out, uint count) {
  if (FIRST >= count) return;
  const vfloat k = drawBinomial(loadUint(bits, FIRST), loadFloat(n, FIRST),
                                makeBinomialOdds(loadFloat(p, FIRST)));
  storeFloat(k, out, FIRST);
}
