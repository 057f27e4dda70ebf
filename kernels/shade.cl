// The shading entry point: one work-item shades WIDTH entries of one material's pixel list.
#include "config.clh"
#include "types.h"
#include "wide.clh"

#include "beckmann.clh"
#include "frame.clh"
#if GLINT
#include "glint.clh"
#endif

// Below this probability a light adds nothing: the lobe is 1e-12 of a microdetail's peak.
#define MIN_PROBABILITY 1e-12f

// What a light does to a pixel before microdetails are counted.
typedef struct {
  vfloat specular;        // mean over the light of G D / (4 o.n), Fresnel term left out
  vfloat schlick;         // the same times (1 - cos)^5
  vfloat cosine;          // mean of max(i.n, 0)
  vfloat probability;     // of a microdetail reflecting, [ZK16] Eq. 7; 0 out of the light's reach
  vfloat half_u, half_v;  // paraboloid map of the half vector of the light's axis
} LightLobe;

#if LIGHT_CONE
// The smooth lobe under one light, averaged over the light's taps.
WIDE LightLobe evaluateLight(ShadingFrame frame, vfloat3 view, SmithLambda lambda_view,
                             constant const GlintMaterial* material,
                             constant const LightParams* light, constant const float4* taps) {
  vfloat density = (vfloat)(0.0f);
  LightLobe lobe;
  lobe.specular = lobe.schlick = lobe.cosine = (vfloat)(0.0f);
  for (uint t = 0; t < light->tap_count; ++t) {
    const vfloat3 tap = toLocal(frame, broadcast3(taps[light->first_tap + t]));
    const vfloat3 l = {tap.x, tap.y, max(tap.z, (vfloat)(0.0f))};
    const vfloat above = (tap.z > 0.0f) ? (vfloat)(1.0f) : (vfloat)(0.0f);
    const HalfSlope h = halfSlope(l, view);
    const SlopeMatrix a = widenedAlpha(material->alpha_g, l, h, light->tap_variance);
    const vfloat p22 = slopeDensity(a, h);
#if GLINT && GROOVE
    // The density across the grooves alone; along them the lobe stays smooth.
    density = fma(above, grooveDensity(a.vv, h.v), density);
#else
    density = fma(above, p22, density);
#endif
    const vfloat value =
        above * specularTerm(p22, h, smithLambda(l, material->alpha_g), lambda_view, view.z);
    lobe.specular += value;
    lobe.schlick = fma(value, schlickWeight(h), lobe.schlick);
    lobe.cosine += l.z;
  }
  const float per_tap = 1.0f / (float)light->tap_count;
  lobe.specular *= per_tap;
  lobe.schlick *= per_tap;
  lobe.cosine *= per_tap;

  // P(h) = D_g(h) / D_l(0), both widened by the light.
  const vfloat3 axis = toLocal(frame, broadcast3(light->direction));
  const HalfSlope h = halfSlope(axis, view);
  const SlopeMatrix micro = widenedAlpha(material->alpha_l, axis, h, light->variance);
#if GLINT && GROOVE
  const vfloat peak_sq = PI * micro.vv;
#else
  const vfloat peak_sq = PI * PI * micro.determinant;
#endif
  lobe.probability = min(density * per_tap * peak_sq * wideRsqrt(peak_sq), (vfloat)(1.0f));
  const vfloat inverse = wideReciprocal(h.length_sq * wideRsqrt(h.length_sq) + h.sum_z);
  lobe.half_u = (axis.x + view.x) * inverse;
  lobe.half_v = (axis.y + view.y) * inverse;
  return lobe;
}
#else
// The smooth lobe under one point light.
WIDE LightLobe evaluateLight(ShadingFrame frame, vfloat3 view, SmithLambda lambda_view,
                             constant const GlintMaterial* material,
                             constant const LightParams* light, constant const float4* taps) {
  const float2 alpha_g = material->alpha_g, alpha_l = material->alpha_l;
  const vfloat3 axis = toLocal(frame, broadcast3(light->direction));
  const vfloat3 l = {axis.x, axis.y, max(axis.z, (vfloat)(0.0f))};
  const vmask above = axis.z > 0.0f;
  const HalfSlope h = halfSlope(l, view);
  const vfloat p22 = above ? pointSlopeDensity(alpha_g, h) : (vfloat)(0.0f);
  LightLobe lobe;
  lobe.specular = specularTerm(p22, h, smithLambda(l, alpha_g), lambda_view, view.z);
  lobe.schlick = lobe.specular * schlickWeight(h);
  lobe.cosine = l.z;

  // P(h) = D_g(h) / D_l(0).
#if GLINT && GROOVE
  const vfloat density = grooveDensity((vfloat)(alpha_g.y * alpha_g.y), h.v);
  lobe.probability =
      above ? min(density * (alpha_l.y * 1.77245385f), (vfloat)(1.0f)) : (vfloat)(0.0f);
#else
  lobe.probability = min(p22 * (PI * alpha_l.x * alpha_l.y), (vfloat)(1.0f));
#endif
  const vfloat inverse = wideReciprocal(h.length_sq * wideRsqrt(h.length_sq) + h.sum_z);
  lobe.half_u = (l.x + view.x) * inverse;
  lobe.half_v = (l.y + view.y) * inverse;
  return lobe;
}
#endif

#if GLINT
// The half vector in cells of its own grid, paraboloid-mapped [ZK16] Sect. 4.3. A cell is as large
// as the effective area of a microdetail's lobe, pi alpha^2: sqrt(pi) (alpha + cone) in slopes, and
// half of that under the paraboloid map, which is slope / 2 near the normal.
WIDE HalfVectorCell halfVectorCell(LightLobe lobe, constant const GlintMaterial* material,
                                   float cone_slope) {
  const float half_sqrt_pi = 0.88622693f;
  const float2 side = max(half_sqrt_pi * (material->alpha_l + cone_slope), (float2)(4e-5f));
  const float2 scale = 65536.0f / side;
  HalfVectorCell cell;
  cell.odds = makeBinomialOdds(lobe.probability);
#if GROOVE
  cell.h_u = (vint)(0);
#else
  cell.h_u = toInt(floor(lobe.half_u * scale.x));
#endif
  cell.h_v = toInt(floor(lobe.half_v * scale.y));
  return cell;
}

WIDE CellMaterial cellMaterial(constant const GlintMaterial* material, float2 gamma) {
  CellMaterial m;
  m.density = material->density / (gamma.x * gamma.y);
#if SIZE_VARIATION
  m.size_scale = material->size_variation / BYTE_SUM_SIGMA;
  m.size_offset = fma(-BYTE_SUM_MEAN, m.size_scale, 1.0f);
#endif
  m.most_expected = 0x1p30f / fma(material->size_variation, 3.5f, 1.0f);
#if GLINT_COLOUR
  m.material = material;
  m.mean_colour.x = m.mean_colour.y = m.mean_colour.z = (vfloat)(1.0f);
  if (material->palette_count > 0u) {
    float4 sum = (float4)(0.0f);
    for (uint i = 0; i < material->palette_count; ++i) sum += material->palette[i];
    m.mean_colour = broadcast3(sum / (float)material->palette_count);
  }
#endif
  return m;
}

WIDE Footprint loadFootprint(global const uint* planes, size_t stride, size_t entry, float2 gamma) {
#define LOAD(plane) loadUint(planes, (plane)*stride + entry)
  const FixedUv u = {bitsToInt(LOAD(PLANE_U_INT)), LOAD(PLANE_U_FRAC)};
  const FixedUv v = {bitsToInt(LOAD(PLANE_V_INT)), LOAD(PLANE_V_FRAC)};
  return makeFootprint(u, v, bitsToFloat(LOAD(PLANE_DUDX)), bitsToFloat(LOAD(PLANE_DVDX)),
                       bitsToFloat(LOAD(PLANE_DUDY)), bitsToFloat(LOAD(PLANE_DVDY)), gamma);
#undef LOAD
}
#endif

// Unit vector from the pixel's surface to the eye, in the local frame.
WIDE vfloat3 viewDirection(vuint pixel, constant const FrameParams* frame, ShadingFrame basis) {
  const vfloat px = toFloat(pixel & 0xFFFFu), py = toFloat(pixel >> 16);
  const vfloat3 start = broadcast3(frame->ray_origin);
  const vfloat3 dx = broadcast3(frame->ray_dx), dy = broadcast3(frame->ray_dy);
  const vfloat3 ray = {fma(px, dx.x, fma(py, dy.x, start.x)), fma(px, dx.y, fma(py, dy.y, start.y)),
                       fma(px, dx.z, fma(py, dy.z, start.z))};
  vfloat3 view = toLocal(basis, scale3(ray, -wideRsqrt(dot3(ray, ray))));
  // Interpolated normals may turn from the eye at silhouettes; keep Eq. 1 finite there.
  view.z = max(view.z, (vfloat)(1e-4f));
  return view;
}

// planes: frame->plane_stride entries each, slots given by the PLANE_* switches. radiance: three
// planes (r, g, b) of the same stride. cells: visited cells | 2^31 where a limit cut the walk.
kernel void shade(global const uint* planes, constant const FrameParams* frame,
                  constant const GlintMaterial* material, constant const LightParams* lights,
                  constant const float4* taps, global float* radiance
#if COUNT_CELLS
                  ,
                  global uint* cell_counts
#endif
) {
  const size_t first = get_global_id(0) * WIDTH;
  if (first >= frame->list_count) return;
  const size_t entry = frame->list_offset + first;
  const size_t stride = frame->plane_stride;

  const ShadingFrame basis = unpackFrame(loadUint(planes, PLANE_FRAME0 * stride + entry),
                                         loadUint(planes, PLANE_FRAME1 * stride + entry));
  const vfloat3 view =
      viewDirection(loadUint(planes, PLANE_PIXEL * stride + entry), frame, basis);
  const SmithLambda lambda_view = smithLambda(view, material->alpha_g);

#if GLINT
  const float2 gamma = gridStretch(material->alpha_g, material->alpha_l);
  const Footprint footprint = loadFootprint(planes, stride, entry, gamma);
  const CellMaterial cell_material = cellMaterial(material, gamma);
  const PixelCells pixel_cells = makePixelCells(&footprint, &cell_material);
#endif
  vint cells = (vint)(0);
  vmask limited = (vint)(0);

  vfloat3 sum = {(vfloat)(0.0f), (vfloat)(0.0f), (vfloat)(0.0f)};
  for (uint i = 0; i < frame->light_count; ++i) {
    constant const LightParams* light = &lights[i];
    const LightLobe lobe = evaluateLight(basis, view, lambda_view, material, light, taps);
    vfloat3 ratio = {(vfloat)(1.0f), (vfloat)(1.0f), (vfloat)(1.0f)};
#if GLINT
    const vmask lit = lobe.probability > MIN_PROBABILITY;
    ratio.x = ratio.y = ratio.z = (vfloat)(0.0f);
    if (anyLane(lit)) {
      const HalfVectorCell half_cell = halfVectorCell(lobe, material, light->direction.w);
      vint visited = (vint)(0);
      vmask cut = (vint)(0);
      const GlintSum share = glintRatio(&pixel_cells, &half_cell, &cell_material, &visited, &cut);
      // Relative to its expectation, so that the smooth lobe carries units and energy.
      const vfloat inverse =
          lit ? wideReciprocal(max(lobe.probability, (vfloat)(MIN_PROBABILITY))) : (vfloat)(0.0f);
#if GLINT_COLOUR
      ratio.x = share.x * inverse;
      ratio.y = share.y * inverse;
      ratio.z = share.z * inverse;
#else
      ratio.x = ratio.y = ratio.z = share * inverse;
#endif
      cells += lit ? visited : (vint)(0);
      limited = limited | (cut & lit);
    }
#endif
    const float4 f0 = material->f0, power = light->power;
    const float scale = material->intensity;
    sum.x += ratio.x * fma(lobe.specular, (vfloat)(f0.x), lobe.schlick * (1.0f - f0.x)) *
             (scale * power.x);
    sum.y += ratio.y * fma(lobe.specular, (vfloat)(f0.y), lobe.schlick * (1.0f - f0.y)) *
             (scale * power.y);
    sum.z += ratio.z * fma(lobe.specular, (vfloat)(f0.z), lobe.schlick * (1.0f - f0.z)) *
             (scale * power.z);
#if DIFFUSE
    sum.x = fma(lobe.cosine, (vfloat)(material->albedo.x * power.x * INV_PI), sum.x);
    sum.y = fma(lobe.cosine, (vfloat)(material->albedo.y * power.y * INV_PI), sum.y);
    sum.z = fma(lobe.cosine, (vfloat)(material->albedo.z * power.z * INV_PI), sum.z);
#endif
  }
  storeFloat(sum.x, radiance, entry);
  storeFloat(sum.y, radiance, stride + entry);
  storeFloat(sum.z, radiance, 2 * stride + entry);
#if COUNT_CELLS
  storeUint(bitsToUint(cells) | (limited ? (vuint)(0x80000000u) : (vuint)(0u)), cell_counts, entry);
#endif
}
