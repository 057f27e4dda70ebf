// Probes of a device: sizes of the shared structs, peak of fused multiply-adds, bandwidth.
#include "config.clh"
#include "types.h"

#if WIDTH == 1
typedef float probe_float;
#define FIRST(vector) (vector)
#elif WIDTH == 4
typedef float4 probe_float;
#elif WIDTH == 8
typedef float8 probe_float;
#else
typedef float16 probe_float;
#endif
#ifndef FIRST
#define FIRST(vector) ((vector).s0)
#endif

#define OFFSET_OF(object, member) ((uint)((char*)&(object).member - (char*)&(object)))

// Sizes in the order of kSharedTypeSizes, host/core/shared_types.h. One work-item.
__kernel void probeTypeSizes(__global uint* out) {
  out[0] = (uint)sizeof(MaterialParams);
  out[1] = (uint)sizeof(ConeLight);
  out[2] = (uint)sizeof(LightParams);
  out[3] = (uint)sizeof(FrameParams);
  out[4] = (uint)sizeof(MipTexture);
  out[5] = (uint)sizeof(AreaLightParams);
  out[6] = (uint)sizeof(SurfaceMaterial);
  out[7] = (uint)sizeof(GlintMaterial);
}

// Byte offsets of members that follow a change of alignment. One work-item.
__kernel void probeTypeOffsets(__global uint* out) {
  MaterialParams material;
  ConeLight light;
  LightParams ready_light;
  FrameParams params;
  out[0] = OFFSET_OF(material, glints.alpha_l);
  out[1] = OFFSET_OF(material, glints.density);
  out[2] = OFFSET_OF(material, glints.palette_count);
  out[3] = OFFSET_OF(material, surface.f0);
  out[4] = OFFSET_OF(material, glints.palette);
  out[5] = OFFSET_OF(light, irradiance);
  out[6] = OFFSET_OF(ready_light, one_minus_cos);
  out[7] = OFFSET_OF(ready_light, cotangent);
  out[8] = OFFSET_OF(params, light_count);
  out[9] = OFFSET_OF(params, plane_stride);
}

// Twelve chains: two FMA ports of four cycles' latency need eight, and with the two constants
// twelve still leave registers to spare. 2 * 12 * WIDTH operations per round and work-item.
// With a = b = 0.5 every chain ends at exactly 1 after some 40 rounds, so that the answer, twelve,
// can be checked; no chain meets infinities or denormals. The seeds come from memory so that no
// compiler knows them, and neither that none is negative, all the same number of rounds: PoCL 7
// turns a loop of one length for all work-items inside out and keeps the chains in memory.
__kernel void probeFma(__global probe_float* inout, uint rounds, float a, float b) {
  const uint id = (uint)get_global_id(0);
  const probe_float va = (probe_float)(a), vb = (probe_float)(b);
  const probe_float seed = inout[id];
  probe_float x0 = seed, x1 = seed + 1.0f, x2 = seed + 2.0f, x3 = seed + 3.0f;
  probe_float x4 = seed + 4.0f, x5 = seed + 5.0f, x6 = seed + 6.0f, x7 = seed + 7.0f;
  probe_float x8 = seed + 8.0f, x9 = seed + 9.0f, x10 = seed + 10.0f, x11 = seed + 11.0f;
  const uint own_rounds = rounds + (FIRST(seed) < 0.0f ? 1u : 0u);
  for (uint i = 0; i < own_rounds; ++i) {
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
  inout[id] = ((x0 + x1) + (x2 + x3)) + ((x4 + x5) + (x6 + x7)) + ((x8 + x9) + (x10 + x11));
}

__kernel void probeFill(__global probe_float* out, float value, uint count) {
  const uint id = (uint)get_global_id(0);
  if (id < count) out[id] = (probe_float)(value);
}

// a = b + s * c over `count` vectors of WIDTH floats: 12 * WIDTH bytes each.
__kernel void probeTriad(__global probe_float* a, __global const probe_float* b,
                         __global const probe_float* c, float s, uint count) {
  const uint id = (uint)get_global_id(0);
  if (id < count) a[id] = b[id] + s * c[id];
}
