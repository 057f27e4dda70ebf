// Runs the published shader's hash and binomial draw over arrays.
#include "glint/published_draws.clh"

#define FIRST (get_global_id(0) * WIDTH)

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

WIDE_KERNEL void probeSineHash(global const float* n, global float* out, uint count) {
  if (FIRST >= count) return;
  storeFloat(sineHash(loadFloat(n, FIRST)), out, FIRST);
}

WIDE_KERNEL void probePublishedBinomial(global const float* u, global const float* n,
                                        global const float* p, global float* out, uint count) {
  if (FIRST >= count) return;
  storeFloat(publishedBinomial(loadFloat(u, FIRST), loadFloat(n, FIRST), loadFloat(p, FIRST)), out,
             FIRST);
}
