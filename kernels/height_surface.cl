// Makes one random rough surface: heights from waves with random phases, then the cone map that
// rays skip empty space with.
//
// The tile repeats, so its waves are those of the discrete Fourier transform:
//   h(x, y) = sum over (i, j) of a_ij cos(2 pi (i x + j y) / HF_TILE + phase_ij)
// with amplitudes from the host (host/simulate/surface_spectrum.cpp), the same for every surface,
// so that each has exactly the wanted slope variance; only the phases are drawn. The sum over j
// comes first, then that over i.
#include "heightfield.h"
#include "types.h"

#include "hash.clh"

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
  const uint here = (uint)counts[row + x] & 0xFFFFu;
  heights[item] = here | ((uint)counts[row + (x + 1u) % HF_TILE] << 16);
}

// Highest vertex of every block, its borders included; then the same of the surface upside down.
// One work-item per block.
kernel void blockTops(global const int* counts, global int* tops) {
  const uint item = (uint)get_global_id(0);
  if (item >= HF_CONE_WORDS) return;
  const uint block_x = item % HF_BLOCKS << HF_BLOCK_SHIFT, block_y = item / HF_BLOCKS << HF_BLOCK_SHIFT;
  int highest = -HF_MOST_COUNTS, lowest = HF_MOST_COUNTS;
  for (uint y = 0; y <= 1u << HF_BLOCK_SHIFT; ++y) {
    for (uint x = 0; x <= 1u << HF_BLOCK_SHIFT; ++x) {
      const int h = counts[(block_y + y) % HF_TILE * HF_TILE + (block_x + x) % HF_TILE];
      highest = max(highest, h);
      lowest = min(lowest, h);
    }
  }
  tops[item] = highest;
  tops[HF_CONE_WORDS + item] = -lowest;
}

// Cones. From a point over a block, at the height of the highest vertex of the 3 x 3 blocks around
// it or above, rays that rise more steeply than the slope meet nothing. Blocks beyond the reach are
// taken to be as high as counts go, which is safe. One work-item per block and side.
#define CONE_REACH 12
kernel void blockCones(global const int* tops, global uint* cones) {
  const uint item = (uint)get_global_id(0);
  if (item >= 2u * HF_CONE_WORDS) return;
  global const int* side = tops + item / HF_CONE_WORDS * HF_CONE_WORDS;
  const uint block = item % HF_CONE_WORDS;
  const int x = (int)(block % HF_BLOCKS), y = (int)(block / HF_BLOCKS);
  int top = -HF_MOST_COUNTS;
  for (int i = 0; i < 9; ++i) {
    const uint row = (uint)(y + i / 3 - 1) % HF_BLOCKS, column = (uint)(x + i % 3 - 1) % HF_BLOCKS;
    top = max(top, side[row * HF_BLOCKS + column]);
  }
  // Slopes are counts per block here. What is left out of a ring is farther away than its gap.
  float slope = (float)(HF_MOST_COUNTS - top) / (float)CONE_REACH;
  for (int dy = -CONE_REACH; dy <= CONE_REACH; ++dy) {
    global const int* row = side + (uint)(y + dy) % HF_BLOCKS * HF_BLOCKS;
    for (int dx = -CONE_REACH; dx <= CONE_REACH; ++dx) {
      const int rise = row[(uint)(x + dx) % HF_BLOCKS] - top;
      // Distance between the two squares, no more than what any ray flies between them.
      const int gap_x = max((int)abs(dx) - 1, 0), gap_y = max((int)abs(dy) - 1, 0);
      if (rise > 0) slope = max(slope, (float)rise * rsqrt((float)(gap_x * gap_x + gap_y * gap_y)));
    }
  }
  // The remainder covers rounding, here and in the kernel that reads it.
  slope = ceil(slope * (1.0001f / (float)(1u << HF_BLOCK_SHIFT))) + 1.0f;
  cones[item] = ((uint)top & 0xFFFFu) | ((uint)min(slope, 65535.0f) << 16);
}
