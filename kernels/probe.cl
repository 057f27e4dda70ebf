// Probes of a device: sizes of the shared structs, peak of fused multiply-adds, bandwidth.
#include "types.h"

#ifndef WIDTH
#define WIDTH 1
#endif

#if WIDTH == 1
typedef float probe_float;
#elif WIDTH == 4
typedef float4 probe_float;
#elif WIDTH == 8
typedef float8 probe_float;
#elif WIDTH == 16
typedef float16 probe_float;
#else
#error WIDTH must be 1, 4, 8 or 16
#endif

// Byte offset of a member, from a pointer that is never read through.
#define OFFSET_OF(type, member) ((uint)(size_t)(&((__private type*)0)->member))

// Sizes in the order of kSharedTypeSizes, then offsets in the order of kSharedTypeOffsets, both of
// host/core/shared_types.h. One work-item.
__kernel void probeTypeSizes(__global uint* out) {
  out[0] = (uint)sizeof(GlintMaterial);
  out[1] = (uint)sizeof(ConeLight);
  out[2] = (uint)sizeof(FrameParams);
}

// 12 independent chains hide the latency of 4 cycles on two FMA ports and still leave registers.
// Returns 2 * 12 * WIDTH operations per round and work-item. With a in (0, 1) every chain converges
// to b / (1 - a): no infinities, no denormals.
__kernel void probeFma(__global float* out, uint rounds, float a, float b) {
  const uint id = (uint)get_global_id(0);
  const probe_float va = (probe_float)(a), vb = (probe_float)(b);
  const probe_float seed = (probe_float)((float)id);
  probe_float x0 = seed, x1 = seed + 1.0f, x2 = seed + 2.0f, x3 = seed + 3.0f;
  probe_float x4 = seed + 4.0f, x5 = seed + 5.0f, x6 = seed + 6.0f, x7 = seed + 7.0f;
  probe_float x8 = seed + 8.0f, x9 = seed + 9.0f, x10 = seed + 10.0f, x11 = seed + 11.0f;
  for (uint i = 0; i < rounds; ++i) {
    x0 = fma(x0, va, vb);
    x1 = fma(x1, va, vb);
    x2 = fma(x2, va, vb);
    x3 = fma(x3, va, vb);
    x4 = fma(x4, va, vb);
    x5 = fma(x5, va, vb);
    x6 = fma(x6, va, vb);
    x7 = fma(x7, va, vb);
    x8 = fma(x8, va, vb);
    x9 = fma(x9, va, vb);
    x10 = fma(x10, va, vb);
    x11 = fma(x11, va, vb);
  }
  const probe_float sum =
      ((x0 + x1) + (x2 + x3)) + ((x4 + x5) + (x6 + x7)) + ((x8 + x9) + (x10 + x11));
  ((__global probe_float*)out)[id] = sum;
}

// a = b + s * c over `count` vectors of WIDTH floats: 12 * WIDTH bytes each.
__kernel void probeTriad(__global probe_float* a, __global const probe_float* b,
                         __global const probe_float* c, float s, uint count) {
  const uint id = (uint)get_global_id(0);
  if (id < count) a[id] = b[id] + s * c[id];
}
