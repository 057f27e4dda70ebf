// The shading entry point: one work-item shades WIDTH entries of a pixel list. A program for one
// material shades that material's list; a program for all materials (ALL_MATERIALS) shades any
// list, with each entry's material in `owners`.
#include "config.clh"
#include "types.h"
#include "wide/wide.clh"

#include "shade_pixels.clh"

#if ALL_MATERIALS
// Shades entries `entry` and following, which may belong to several materials: one after another,
// each by its own branches, and every lane keeps what its own material gave.
WIDE vfloat3 shadeOwners(Shading shading, vint owner, size_t entry) {
  vfloat3 sum = {(vfloat)(0.0f), (vfloat)(0.0f), (vfloat)(0.0f)};
  constant const MaterialParams* materials = shading.material;
#if NORMAL_MAP
  constant const MipTexture* maps = shading.map;
#endif
#if SCATTERING
  constant const MultiscatterMaterial* scatters = shading.scatter;
#endif
  for (int index = maxLane(owner); index >= 0; index = maxLane(owner)) {
    shading.material = &materials[index];
#if NORMAL_MAP
    shading.map = &maps[index];
#endif
#if SCATTERING
    shading.scatter = &scatters[index];
#endif
    const vfloat3 shaded = shadePixels(&shading, entry);
    const vmask own = owner == index;
    sum.x = own ? shaded.x : sum.x;
    sum.y = own ? shaded.y : sum.y;
    sum.z = own ? shaded.z : sum.z;
    owner = own ? (vint)(-1) : owner;
  }
  return sum;
}
#endif

// planes: see Shading. radiance: three planes (r, g, b) of the same stride. cell_counts: two
// planes, visited cells | 2^31 where a limit cut the walk, and cells paid for. With ALL_MATERIALS
// material, map and scatter are arrays over all materials.
WIDE_KERNEL void shade(global const uint* planes, constant const FrameParams* frame,
                       constant const MaterialParams* material, constant const LightParams* lights,
#if GLINT && GLINT_TABLE
                       global const float* glint_table,
#endif
#if NORMAL_MAP
                       constant const MipTexture* map, global const float4* map_texels,
#endif
#if LTC
                       constant const AreaLightParams* area_lights, global const float* ltc_table,
#if LIGHT_TEXTURE
                       constant const MipTexture* pictures, global const float4* picture_texels,
#endif
#endif
#if SCATTERING
                       constant const MultiscatterMaterial* scatter,
#endif
#if LIGHT_TAPS
                       constant const LightTaps* light_taps, constant const float4* taps,
#endif
#if ALL_MATERIALS
                       global const uint* owners,
#endif
                       global float* restrict radiance
#if COUNT_CELLS
                       ,
                       global uint* restrict cell_counts
#endif
) {
  const size_t first = get_global_id(0) * WIDTH;
  if (first >= frame->list_count) return;
  const size_t entry = frame->list_offset + first;
  const size_t stride = frame->plane_stride;

  Shading shading;
  shading.planes = planes;
  shading.frame = frame;
  shading.material = material;
  shading.lights = lights;
#if GLINT && GLINT_TABLE
  shading.glint_table = glint_table;
#endif
#if NORMAL_MAP
  shading.map = map;
  shading.map_texels = map_texels;
#endif
#if SCATTERING
  shading.scatter = scatter;
#endif
#if LIGHT_TAPS
  shading.light_taps = light_taps;
  shading.taps = taps;
#endif
#if LTC
  shading.area_lights = area_lights;
  shading.ltc_table = ltc_table;
#if LIGHT_TEXTURE
  shading.pictures = pictures;
  shading.picture_texels = picture_texels;
#endif
#endif
#if COUNT_CELLS
  VisitedCells visited = {(vint)(0), (vint)(0), (vint)(0)};
  shading.visited = &visited;
#endif

#if ALL_MATERIALS
  const vfloat3 sum = shadeOwners(shading, bitsToInt(loadUint(owners, entry)), entry);
#else
  const vfloat3 sum = shadePixels(&shading, entry);
#endif
  storeFloat(sum.x, radiance, entry);
  storeFloat(sum.y, radiance, stride + entry);
  storeFloat(sum.z, radiance, 2 * stride + entry);
#if COUNT_CELLS
  storeUint(bitsToUint(visited.count) | (visited.limited ? (vuint)(0x80000000u) : (vuint)(0u)),
            cell_counts, entry);
  storeUint(bitsToUint(visited.paid), cell_counts, stride + entry);
#endif
}
