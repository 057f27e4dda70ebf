// Glints in a renderer of its own: no planes, no frames, no host of ours. README.md says more.
#include "glint/glint.clh"

// hits: 14 arrays of `count` words, a multiple of WIDTH: unit vectors to eye (0 to 2) and light (3
// to 5) in the tangent frame; u (6: whole part, 7: the rest times 2^32) and v (8, 9); du/dx, dv/dx,
// du/dy, dv/dy per pixel (10 to 13). irradiance: rgb on a surface that faces the light. radiance:
// arrays of r, g and b. glint_table: of the methods that have one. One work-item shades WIDTH hits.
WIDE_KERNEL void shadeHits(global const uint* hits, constant const MaterialParams* material,
                           float4 irradiance, global float* radiance,
                           uint count GLINT_TABLE_PARAMETER) {
  const size_t stride = count, i = get_global_id(0) * WIDTH;
  if (i >= stride) return;
#define WORD(array) loadUint(hits, (array)*stride + i)
#define NUMBER(array) bitsToFloat(WORD(array))
  const vfloat3 view = {NUMBER(0), NUMBER(1), NUMBER(2)};
  const vfloat3 light = {NUMBER(3), NUMBER(4), NUMBER(5)};
  GlintUv uv;
  uv.u.whole = bitsToInt(WORD(6));
  uv.u.fraction = WORD(7);
  uv.v.whole = bitsToInt(WORD(8));
  uv.v.fraction = WORD(9);
  uv.du_dx = NUMBER(10);
  uv.dv_dx = NUMBER(11);
  uv.du_dy = NUMBER(12);
  uv.dv_dy = NUMBER(13);
  const vfloat3 reflected = glint(view, light, uv, material GLINT_TABLE_ARGUMENT(glint_table));
  storeFloat(reflected.x * irradiance.x, radiance, i);
  storeFloat(reflected.y * irradiance.y, radiance, stride + i);
  storeFloat(reflected.z * irradiance.z, radiance, 2 * stride + i);
}
