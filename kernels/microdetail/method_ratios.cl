// What a glint method makes of the smooth lobe, over the pixels of this folder.
#include "glint/glint.clh"
#include "microdetail/microdetail.h"

// ratios: planes of r, g, b, 1 on average. The half vector has the slope (half_u, half_v)
// everywhere, so that pixels differ in their place on the texture only. One work-item: WIDTH pixels
// of `stride`, a multiple of WIDTH.
WIDE_KERNEL void methodRatios(global const uint* pixels, constant const MaterialParams* material,
                              global float* ratios, float half_u, float half_v,
                              uint stride GLINT_TABLE_PARAMETER) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= stride) return;
#define WORD(plane) loadUint(pixels, (plane) * (size_t)stride + i)
  GlintUv uv;
  uv.u.whole = bitsToInt(WORD(MD_U_WHOLE));
  uv.u.fraction = WORD(MD_U_FRACTION);
  uv.v.whole = bitsToInt(WORD(MD_V_WHOLE));
  uv.v.fraction = WORD(MD_V_FRACTION);
  uv.du_dx = bitsToFloat(WORD(MD_DUDX));
  uv.dv_dx = bitsToFloat(WORD(MD_DVDX));
  uv.du_dy = bitsToFloat(WORD(MD_DUDY));
  uv.dv_dy = bitsToFloat(WORD(MD_DVDY));
#undef WORD
  const float3 half_vector = normalize((float3)(half_u, half_v, 1.0f));
  const vfloat3 direction = {(vfloat)(half_vector.x), (vfloat)(half_vector.y),
                             (vfloat)(half_vector.z)};
  const SurfaceAlpha alpha = surfaceAlpha(material->surface.alpha_g);
  const LightLobe lobe =
      pointLobe(direction, direction, smithLambda(direction, alpha), alpha, material);
  const PixelGlints pixel = makePixelGlints(uv, material GLINT_TABLE_ARGUMENT(glint_table));
  VisitedCells not_counted = {(vint)(0), (vint)(0), (vint)(0)};
  const vfloat3 ratio = microdetailRatio(&pixel, lobe, material, (ConeSlope)(0.0f), &not_counted);
  storeFloat(ratio.x, ratios, i);
  storeFloat(ratio.y, ratios, stride + i);
  storeFloat(ratio.z, ratios, 2 * (size_t)stride + i);
}
