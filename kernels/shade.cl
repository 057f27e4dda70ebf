// The shading entry point: one work-item shades WIDTH entries of one material's pixel list.
#include "config.clh"
#include "types.h"
#include "wide.clh"

#if LTC
#include "area_surface.clh"
#endif
#include "pixel.clh"
#if CONE_LIGHTS
#include "cone_light.clh"
#if MULTISCATTER != MULTISCATTER_OFF || METAL_COMPENSATION
#include "multiscatter.clh"
#endif
#if GLINT
#include "glint_pixel.clh"
#endif
#if NORMAL_MAP
#include "normal_surface.clh"
#endif
#endif

// planes: frame->plane_stride entries each, slots given by the PLANE_* switches. radiance: three
// planes (r, g, b) of the same stride. cells: visited cells | 2^31 where a limit cut the walk.
kernel void shade(global const uint* planes, constant const FrameParams* frame,
                  constant const GlintMaterial* material, constant const LightParams* lights,
                  constant const float4* taps,
#if NORMAL_MAP
                  constant const MipTexture* map, global const float4* map_texels,
#endif
#if MULTISCATTER != MULTISCATTER_OFF || METAL_COMPENSATION
                  constant const MultiscatterMaterial* scatter,
#endif
#if LTC
                  constant const AreaLightParams* area_lights, global const float* ltc_table,
#if LIGHT_TEXTURE
                  constant const MipTexture* pictures, global const float4* picture_texels,
#endif
#endif
                  global float* radiance
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
  vfloat3 sum = {(vfloat)(0.0f), (vfloat)(0.0f), (vfloat)(0.0f)};
#if COUNT_CELLS
  vint cells = (vint)(0);
  vmask limited = (vint)(0);
#endif
#if CONE_LIGHTS
  const vfloat3 view = viewDirection(loadUint(planes, PLANE_PIXEL * stride + entry), frame, basis);
  const SmithLambda lambda_view = smithLambda(view, material->alpha_g);

#if MULTISCATTER != MULTISCATTER_OFF
  const ScatterView view_terms = scatterView(view, scatter);
#endif
#if METAL_COMPENSATION
  const vfloat lost_energy = lostEnergy(view.z, scatter);
#endif

#if GLINT
  const float2 gamma = gridStretch(material->alpha_g, material->alpha_l);
  const Footprint footprint = loadFootprint(planes, stride, entry, gamma);
  const CellMaterial cell_material = cellMaterial(material, gamma);
  const PixelCells pixel_cells = makePixelCells(&footprint, &cell_material);
#endif
#if NORMAL_MAP
  const PixelNormals normals = loadNormals(planes, stride, entry, map, map_texels, view, material);
#endif
  for (uint i = 0; i < frame->light_count; ++i) {
    constant const LightParams* light = &lights[i];
#if NORMAL_MAP
    const LightLobe lobe = evaluateMappedLight(&normals, basis, view, material, light, taps);
#else
    const LightLobe lobe = evaluateLight(basis, view, lambda_view, material, light, taps);
#endif
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
#if COUNT_CELLS
      cells += lit ? visited : (vint)(0);
      limited = limited | (cut & lit);
#endif
    }
#endif
#if METAL_COMPENSATION
    ratio = compensate(ratio, lost_energy, material);
#endif
    addLight(lobe, ratio, material, light, &sum);
#if MULTISCATTER != MULTISCATTER_OFF
    addScattered(basis, view, view_terms, scatter, light, taps, &sum);
#endif
  }
#endif
#if LTC
  const LitPoint point = loadLitPoint(planes, stride, entry, frame, material, basis
#if NORMAL_MAP
                                      ,
                                      map, map_texels
#endif
  );
  sum = add3(sum, shadeAreaLights(point, material, area_lights, frame->area_light_count, ltc_table,
                                  frame->ltc_size PICTURE_ARGUMENTS));
#endif
  storeFloat(sum.x, radiance, entry);
  storeFloat(sum.y, radiance, stride + entry);
  storeFloat(sum.z, radiance, 2 * stride + entry);
#if COUNT_CELLS
  storeUint(bitsToUint(cells) | (limited ? (vuint)(0x80000000u) : (vuint)(0u)), cell_counts, entry);
#endif
}
