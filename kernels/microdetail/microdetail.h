// What the kernels of this folder read, once for host and kernels. Rules as in types.h.
#ifndef GLINTMARK_MICRODETAIL_H
#define GLINTMARK_MICRODETAIL_H

// Planes of the pixels, words: the centre's uv as whole number and 32-bit fraction, and the edge
// vectors of the footprint's parallelogram as floats [uv].
#define MD_U_WHOLE 0u
#define MD_U_FRACTION 1u
#define MD_V_WHOLE 2u
#define MD_V_FRACTION 3u
#define MD_DUDX 4u
#define MD_DVDX 5u
#define MD_DUDY 6u
#define MD_DVDY 7u
#define MD_PIXEL_PLANES 8u

// Planes of the sums: microdetails by their lobes (r, g, b), then those that reflect or do not (r,
// g, b).
#define MD_LOBES 0u
#define MD_REFLECTING 3u
#define MD_SUM_PLANES 6u

// How many microdetails a reference cell holds, as upper ends of a 32-bit hash: the first of
// `MD_GUIDE` words says from which count on to look, by the hash's upper byte; the thresholds
// follow, the last is 2^32 - 1.
#define MD_GUIDE 256u

// Microdetails of one material, and how they are placed.
typedef struct MicrodetailField {
  float2 alpha_m;      // Beckmann roughness of the slopes of microdetails
  float2 per_alpha_l;  // one over the roughness of one microdetail
  int cell_level;      // reference cells are 2^cell_level wide [uv], -31 to 29
  uint seed;           // another one is another surface
  uint tap_count;      // half vectors of the light
  uint size_count;     // sizes, all as likely
  uint colour_count;   // colours, all as likely
  uint unused;         // 0
} MicrodetailField;

#endif
