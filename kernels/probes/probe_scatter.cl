// Runs the models of light scattered more than once over arrays.
#include "config.clh"
#include "types.h"
#include "wide/wide.clh"

#include "scatter/multiscatter.clh"

WIDE vfloat loadFloat(global const float* p, size_t i) {
  return bitsToFloat(loadUint((global const uint*)p, i));
}

// in: planes of `count` entries: light (3), view (3), tangent space. out: single and multiple
// scattering without their colours, times the cosine of incidence.
WIDE_KERNEL void probeScatter(global const float* in, constant const MultiscatterMaterial* scatter,
                              global float* out, uint count) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
#define IN(plane) loadFloat(in, (size_t)(plane)*count + i)
  const vfloat3 light = {IN(0), IN(1), IN(2)}, view = {IN(3), IN(4), IN(5)};
#undef IN
  const Scattered s = scatterLight(light, view, scatterView(view, scatter), scatter);
  storeFloat(s.single, out, i);
  storeFloat(s.multiple, out, (size_t)count + i);
}
