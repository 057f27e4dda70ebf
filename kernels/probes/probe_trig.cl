// Runs sine, cosine and angle over arrays.
#include "wide/wide_trig.clh"

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

// in: planes of `count` entries: turns, 0 to 1, then x and y. out: sine and cosine of the turns,
// the angle of (x, y) in turns.
WIDE_KERNEL void probeTrig(global const float* in, global float* out, uint count) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
  const SineCosine turned = sineCosineTurns(loadFloat(in, i));
  storeFloat(turned.sine, out, i);
  storeFloat(turned.cosine, out, count + i);
  storeFloat(angleTurns(loadFloat(in, count + i), loadFloat(in, 2 * (size_t)count + i)), out,
             2 * (size_t)count + i);
}
