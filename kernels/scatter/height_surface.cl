// Makes one random rough surface: heights from waves with random phases, then the cone map that
// rays skip empty space with.
//
// The tile repeats, so its waves are those of the discrete Fourier transform:
//   h(x, y) = sum over (i, j) of a_ij cos(2 pi (i x + j y) / HF_TILE + phase_ij)
// with amplitudes from the host (host/simulate/surface_spectrum.cpp), the same for every surface,
// so that each has exactly the wanted slope variance; only the phases are drawn. The sum over j
// comes first, then that over i.
#include "scatter/heightfield.h"
#include "types.h"

#include "glint/hash.clh"

// amplitudes, modes: HF_MODES x HF_MODE_ROWS, index i * HF_MODE_ROWS + j + HF_MODES - 1; one
// work-item per mode. modes receives a cos(phase), a sin(phase).
kernel void drawModes(global const float* amplitudes, global float2* modes, uint seed) {
  const uint i = (uint)get_global_id(0);
  if (i >= HF_MODES * HF_MODE_ROWS) return;
  uint h = (i + 1u) * 0x9E3779B1u ^ seed;
  h = (h ^ (h >> 16)) * HASH_MIX_1;
  h = (h ^ (h >> 15)) * HASH_MIX_2;
  h = (h ^ (h >> 15)) * HASH_MIX_3;
  const float phase = (float)((h ^ (h >> 16)) >> 8) * (6.28318531f / 16777216.0f);
  modes[i] = amplitudes[i] * (float2)(cos(phase), sin(phase));
}

// waves: cos and sin of 2 pi i x / HF_TILE, index i * HF_TILE + x. columns: for every i and y the
// sum over j, real parts, then imaginary parts, index i * HF_TILE + y. One work-item per 16 y.
kernel void sumColumns(global const float2* modes, global const float* cosines,
                       global const float* sines, global float* columns) {
  const uint item = (uint)get_global_id(0);
  const uint i = item / (HF_TILE / 16u), y = item % (HF_TILE / 16u) * 16u;
  if (i >= HF_MODES) return;
  float16 re = 0.0f, im = 0.0f;
  for (uint row = 0; row < HF_MODE_ROWS; ++row) {
    const int j = (int)row - (int)HF_MODES + 1;
    const float2 m = modes[i * HF_MODE_ROWS + row];
    const size_t wave = (size_t)abs(j) * HF_TILE + y;
    const float16 c = vload16(0, cosines + wave);
    const float16 s = vload16(0, sines + wave) * (j < 0 ? -1.0f : 1.0f);
    re += m.x * c - m.y * s;
    im += m.x * s + m.y * c;
  }
  vstore16(re, 0, columns + i * HF_TILE + y);
  vstore16(im, 0, columns + HF_MODES * HF_TILE + i * HF_TILE + y);
}

// counts: heights in units of `height_count`, index y * HF_TILE + x. One work-item per 16 x.
kernel void sumRows(global const float* columns, global const float* cosines,
                    global const float* sines, global int* counts, float count_height) {
  const uint item = (uint)get_global_id(0);
  const uint y = item / (HF_TILE / 16u), x = item % (HF_TILE / 16u) * 16u;
  if (y >= HF_TILE) return;
  float16 h = 0.0f;
  for (uint i = 0; i < HF_MODES; ++i) {
    const float re = columns[i * HF_TILE + y];
    const float im = columns[HF_MODES * HF_TILE + i * HF_TILE + y];
    h += re * vload16(0, cosines + i * HF_TILE + x) - im * vload16(0, sines + i * HF_TILE + x);
  }
  const float16 most = (float)HF_MOST_COUNTS;
  vstore16(convert_int16_rte(clamp(h / count_height, -most, most)), 0, counts + y * HF_TILE + x);
}

// heights: the packed words. One work-item per word.
kernel void packHeights(global const int* counts, global uint* heights) {
  const uint item = (uint)get_global_id(0);
  if (item >= HF_HEIGHT_WORDS) return;
  const uint row = item / HF_TILE % HF_TILE * HF_TILE, x = item % HF_TILE;
  const uint here = (uint)(counts[row + x] + 32768);
  heights[item] = here | ((uint)(counts[row + (x + 1u) % HF_TILE] + 32768) << 16);
}

// tops: highest vertex of every block, its borders included, for both sides (below, the surface is
// upside down); in rows of HF_TOP_PITCH that repeat what follows on either side. highest: of each
// side, to be set to -HF_MOST_COUNTS before. One work-item per entry of a side.
kernel void blockTops(global const int* counts, global float* tops, global int* highest) {
  const uint item = (uint)get_global_id(0);
  if (item >= HF_TOP_WORDS) return;
  const uint block_x = (item % HF_TOP_PITCH + HF_BLOCKS - HF_CONE_REACH) % HF_BLOCKS;
  const uint block_y = item / HF_TOP_PITCH;
  int top = -HF_MOST_COUNTS, bottom = HF_MOST_COUNTS;
  for (uint y = 0; y <= 1u << HF_BLOCK_SHIFT; ++y) {
    const uint row = ((block_y << HF_BLOCK_SHIFT) + y) % HF_TILE * HF_TILE;
    for (uint x = 0; x <= 1u << HF_BLOCK_SHIFT; ++x) {
      const int h = counts[row + ((block_x << HF_BLOCK_SHIFT) + x) % HF_TILE];
      top = max(top, h);
      bottom = min(bottom, h);
    }
  }
  tops[item] = (float)top;
  tops[HF_TOP_WORDS + item] = (float)-bottom;
  if (top > highest[0]) atomic_max(&highest[0], top);
  if (-bottom > highest[1]) atomic_max(&highest[1], -bottom);
}

// Cones. From a point over a block, at the height of the highest vertex of the blocks next to it or
// above, rays of the octant that rise more steeply than the slope meet nothing. Blocks beyond the
// reach are taken to be as high as the highest. reached: the blocks that rays of an octant can
// come to, HF_REACHED of them for each: dx, dy, 1 / the distance between the squares [1 / blocks],
// 0 for neighbours, which stand first. One work-item per side, octant and 16 blocks in a row.
kernel void blockCones(global const float* tops, global const int* highest,
                       global const float4* reached, global uint* cones) {
  const uint item = (uint)get_global_id(0) * 16u;
  if (item >= 2u * HF_OCTANTS * HF_CONE_WORDS) return;
  const uint map = item / HF_CONE_WORDS, block = item % HF_CONE_WORDS;
  const uint side = map / HF_OCTANTS;
  const int x = (int)(block % HF_BLOCKS), y = (int)(block / HF_BLOCKS);
  global const float* centre = tops + side * HF_TOP_WORDS + x + HF_CONE_REACH;
  global const float4* there = reached + map % HF_OCTANTS * HF_REACHED;
  float16 top = -(float)HF_MOST_COUNTS;
  uint i = 0;
  for (; there[i].z == 0.0f; ++i)
    top = max(top, vload16(0, centre + (uint)(y + (int)there[i].y) % HF_BLOCKS * HF_TOP_PITCH +
                                  (int)there[i].x));
  // Slopes are counts per block here. What lies beyond the reach is at least as many blocks away.
  float16 slope = ((float)highest[side] - top) * (1.0f / (float)HF_CONE_REACH);
  for (; i < HF_REACHED; ++i) {
    const float4 b = there[i];
    global const float* row = centre + (uint)(y + (int)b.y) % HF_BLOCKS * HF_TOP_PITCH;
    slope = max(slope, (vload16(0, row + (int)b.x) - top) * b.z);
  }
  // The remainder covers rounding, here and in the kernel that reads it.
  slope = ceil(slope * (1.0001f / (float)(1u << HF_BLOCK_SHIFT))) + 1.0f;
  const uint16 bits = convert_uint16(min(slope, 65535.0f)) << 16;
  vstore16(convert_uint16(top + 32768.0f) | bits, 0, cones + item);
}
