// Layout of the simulated rough surfaces and of what a simulation counts, once for host and
// kernels. Preprocessor constants and one struct only; rules as in types.h.
//
// A surface is a square tile of heights that repeats in x and y, cut into two flat triangles per
// cell by the diagonal from (x, y) to (x + 1, y + 1). It is made for roughness 1; the kernels
// stretch space so that every roughness, also an anisotropic one, is the same surface.
#ifndef GLINTMARK_HEIGHTFIELD_H
#define GLINTMARK_HEIGHTFIELD_H

#define HF_TILE 256u  // texels per side, a power of two
#define HF_BLOCK_SHIFT 1u
#define HF_BLOCKS (HF_TILE >> HF_BLOCK_SHIFT)  // blocks per side of the cone map
#define HF_MODES 64u                           // wave numbers 0 to 63 along x, -63 to 63 along y
#define HF_MODE_ROWS (2u * HF_MODES - 1u)

// Parts per side of the tile that rays of neighbouring numbers aim at.
#define HF_WINDOW_SHIFT 3
#define HF_WINDOWS (1 << HF_WINDOW_SHIFT)

// Words of the height buffer: one row more than the tile has, so that the row above needs no
// wrapping. A word holds the heights of texel (x, y) and, in its upper half, of (x + 1, y), as
// counts with 32768 added.
#define HF_HEIGHT_WORDS ((HF_TILE + 1u) * HF_TILE)
#define HF_MOST_COUNTS 32767

// The cone maps: for each side and octant of directions a word per block; dx < 0, dy < 0 and
// |dy| > |dx| are the bits of the octant's number. Lower half: highest count of the block and its
// neighbours in that octant, with 32768 added. Upper half: slope [counts per texel] of a cone from
// there that clears what lies beyond.
#define HF_OCTANTS 8u
#define HF_CONE_WORDS (HF_BLOCKS * HF_BLOCKS)  // of one map

// Heights of blocks while the map is made: rows with as many repeated blocks on either side as a
// cone is searched for.
#define HF_CONE_REACH 12
#define HF_TOP_PITCH (HF_BLOCKS + 2u * HF_CONE_REACH)
#define HF_TOP_WORDS (HF_BLOCKS * HF_TOP_PITCH)
// Blocks dx, dy apart that rays of the first octant reach: dx to HF_CONE_REACH, dy to dx + 1.
#define HF_REACHED ((HF_CONE_REACH + 1) * (HF_CONE_REACH + 4) / 2 - 1)

// The histogram: cells of equal solid angle, for each side (above, then below), scattering order
// and cosine the azimuths from +x on. Behind them, counters.
#define HF_COSINES 128u
#define HF_AZIMUTHS 256u
#define HF_CELLS (HF_COSINES * HF_AZIMUTHS)
#define HF_MAX_ORDERS 6u
#define HF_COUNTERS (2u * HF_MAX_ORDERS * HF_CELLS)
#define HF_ABSORBED HF_COUNTERS                     // one per order
#define HF_LEFT_OVER (HF_COUNTERS + HF_MAX_ORDERS)  // alive after the last order
#define HF_GAVE_UP (HF_LEFT_OVER + 1u)              // lost after HF_MOST_STEPS cells and jumps
#define HF_HISTOGRAM_WORDS (HF_GAVE_UP + 1u)

// Cells and jumps that one flight between two bounces may take.
#define HF_MOST_STEPS 16384

typedef struct HeightfieldRun {
  float4 incoming;     // xyz: unit direction in which the rays fly in, z < 0; w unused
  float2 alpha;        // roughness along x and y
  float count_height;  // height of one count at roughness 1 [texels]
  float index_n;       // refractive index: real part
  float index_k;       // and imaginary part (metals)
  uint orders;         // rays are followed to this many bounces, 1 to HF_MAX_ORDERS
  uint rays_per_lane;
  float f0;         // metals of METAL_FRESNEL_TINTED: reflectance at normal incidence
  float dip;        // and how deep it falls towards 82 degrees
  uint padding[3];  // to a multiple of 16 bytes
} HeightfieldRun;

#endif
