// Runs the texture fetch over arrays of footprints, PROBE_TEXEL_SIZE float4 per texel.
#define TEXEL_SIZE PROBE_TEXEL_SIZE
#include "normals/texture_sum_template.clh"

#define NAME2(a, b) a##b
#define NAME1(a, b) NAME2(a, b)

WIDE vfloat loadFloat(global const uint* p, size_t i) { return bitsToFloat(loadUint(p, i)); }

// footprints: planes u, v [2^-32], dudx, dvdx, dudy, dvdy [float bits] of `count` entries each.
// out: per component of the texel a plane; then probes of a row, rows, level and true spread.
WIDE_KERNEL void probeTexture(constant const MipTexture* texture, global const float4* texels,
                              global const uint* footprints, global float* out, uint count,
                              int most_probes, int most_rows, float least_texels, int border) {
  const size_t i = get_global_id(0) * WIDTH;
  if (i >= count) return;
  const ProbeGrid grid =
      footprintProbes(texture, loadUint(footprints, i), loadUint(footprints, count + i),
                      loadFloat(footprints, 2 * count + i), loadFloat(footprints, 3 * count + i),
                      loadFloat(footprints, 4 * count + i), loadFloat(footprints, 5 * count + i),
                      most_probes, most_rows, least_texels);
  vfloat4 values[PROBE_TEXEL_SIZE];
  NAME1(fetchTexels, PROBE_TEXEL_SIZE)(texture, texels, &grid, border, values);
  for (int k = 0; k < PROBE_TEXEL_SIZE; ++k) {
    const size_t plane = 4 * k;
    storeFloat(values[k].x, out, plane * count + i);
    storeFloat(values[k].y, out, (plane + 1) * count + i);
    storeFloat(values[k].z, out, (plane + 2) * count + i);
    storeFloat(values[k].w, out, (plane + 3) * count + i);
  }
  const size_t last = 4 * PROBE_TEXEL_SIZE;
  storeFloat(toFloat(grid.count), out, last * count + i);
  storeFloat(toFloat(grid.rows), out, (last + 1) * count + i);
  storeFloat(grid.level, out, (last + 2) * count + i);
  storeFloat(grid.true_spread, out, (last + 3) * count + i);
}
