// Every microdetail under a pixel, one by one: where it lies, where it points, how much of the
// light it mirrors. Deliberately shares nothing with glint/ but the names of lane types.
//
// Compiled with -D WIDTH (microdetails side by side), -D TENT (0: a pixel weighs its parallelogram
// evenly; 1: a tent over twice the parallelogram), -D MARKED (1: they have sizes and colours).
#include "microdetail/microdetail.h"
#include "types.h"
#include "wide/wide_memory.clh"

// Lane l of a vector in memory.
#define LANE(type, v, l) (((type*)&(v))[l])

// Four independent numbers of 32 bits for four numbers: pcg4d of Jarzynski and Olano 2020, "Hash
// Functions for GPU Rendering", JCGT 9(3).
typedef struct {
  vuint a, b, c, d;
} FourNumbers;

WIDE FourNumbers stirred(FourNumbers n) {
  n.a += n.b * n.d;
  n.b += n.c * n.a;
  n.c += n.a * n.b;
  n.d += n.b * n.c;
  return n;
}

WIDE FourNumbers hashed(vuint cell_u, vuint cell_v, vuint number, uint seed) {
  FourNumbers n = {cell_u, cell_v, number, (vuint)(seed)};
  n.a = n.a * 1664525u + 1013904223u;
  n.b = n.b * 1664525u + 1013904223u;
  n.c = n.c * 1664525u + 1013904223u;
  n.d = n.d * 1664525u + 1013904223u;
  n = stirred(n);
  n.a ^= n.a >> 16;
  n.b ^= n.b >> 16;
  n.c ^= n.c >> 16;
  n.d ^= n.d >> 16;
  return stirred(n);
}

// Streams of one surface: a cell's count; a microdetail's place and slope; its chance, size and
// colour.
#define COUNT_NUMBER 0xFFFFFFFFu
#define MARK_SEED 0x5851F42Du

WIDE vfloat unitInterval(vuint h) { return toFloat(h) * 0x1p-32f; }

WIDE float laneSum(vfloat v) {
  float sum = 0.0f;
  for (int l = 0; l < WIDTH; ++l) sum += LANE(float, v, l);
  return sum;
}

// A pixel in reference cells, relative to the corner of the cell that holds its centre.
typedef struct {
  uint cell_u, cell_v;        // that cell, modulo 2^32
  float2 centre;              // within it
  float2 edge_x, edge_y;      // of the parallelogram
  float2 across_x, across_y;  // dot products with these are coordinates along the edges
} CellPixel;

WIDE CellPixel cellPixel(global const uint* pixels, uint stride, uint entry, int level) {
#define WORD(plane) pixels[(plane) * (size_t)stride + entry]
  const int shift = 32 + level;
  const long u = ((long)as_int(WORD(MD_U_WHOLE)) << 32) + (long)WORD(MD_U_FRACTION);
  const long v = ((long)as_int(WORD(MD_V_WHOLE)) << 32) + (long)WORD(MD_V_FRACTION);
  const long rest = (1L << shift) - 1;
  CellPixel p;
  p.cell_u = (uint)(u >> shift);
  p.cell_v = (uint)(v >> shift);
  p.centre = (float2)(ldexp((float)(u & rest), -shift), ldexp((float)(v & rest), -shift));
  p.edge_x =
      (float2)(ldexp(as_float(WORD(MD_DUDX)), -level), ldexp(as_float(WORD(MD_DVDX)), -level));
  p.edge_y =
      (float2)(ldexp(as_float(WORD(MD_DUDY)), -level), ldexp(as_float(WORD(MD_DVDY)), -level));
#undef WORD
  const float per_area = 1.0f / (p.edge_x.x * p.edge_y.y - p.edge_y.x * p.edge_x.y);
  p.across_x = (float2)(p.edge_y.y, -p.edge_y.x) * per_area;
  p.across_y = (float2)(-p.edge_x.y, p.edge_x.x) * per_area;
  return p;
}

// From the least to the greatest u that the line from `from` to `to` has between v = low and v =
// low + 1 joins `range`.
WIDE float2 joinedByEdge(float2 range, float2 from, float2 to, float low) {
  if (fmax(from.y, to.y) < low || fmin(from.y, to.y) > low + 1.0f) return range;
  const float rise = to.y - from.y;
  float t0 = 0.0f, t1 = 1.0f;
  if (fabs(rise) > 1e-20f) {
    t0 = clamp((low - from.y) / rise, 0.0f, 1.0f);
    t1 = clamp((low + 1.0f - from.y) / rise, 0.0f, 1.0f);
  }
  const float u0 = from.x + t0 * (to.x - from.x), u1 = from.x + t1 * (to.x - from.x);
  return (float2)(fmin(range.x, fmin(u0, u1)), fmax(range.y, fmax(u0, u1)));
}

// What the filter reaches of the row of cells from v = low on; empty if y < x.
WIDE float2 rowRange(const CellPixel* p, float reach, float low) {
  const float2 x = reach * p->edge_x, y = reach * p->edge_y;
  const float2 a = p->centre - x - y, b = p->centre + x - y;
  const float2 c = p->centre + x + y, d = p->centre - x + y;
  float2 range = (float2)(1e30f, -1e30f);
  range = joinedByEdge(range, a, b, low);
  range = joinedByEdge(range, b, c, low);
  range = joinedByEdge(range, c, d, low);
  return joinedByEdge(range, d, a, low);
}

// Microdetails of a cell, by inversion of the distribution of counts.
WIDE uint detailCount(global const uint* counts, uint h) {
  uint k = counts[h >> 24];
  while (h > counts[MD_GUIDE + k]) ++k;
  return k;
}

// Weight of the filter at an offset from the pixel's centre [cells], 1 on average over the
// parallelogram's area.
WIDE vfloat filterWeight(const CellPixel* p, vfloat u, vfloat v) {
  const vfloat a = u * p->across_x.x + v * p->across_x.y;
  const vfloat b = u * p->across_y.x + v * p->across_y.y;
#if TENT
  return max(1.0f - fabs(a), (vfloat)(0.0f)) * max(1.0f - fabs(b), (vfloat)(0.0f));
#else
  // Half open: what lies on an edge belongs to one pixel.
  const vmask inside = (a >= -0.5f) & (a < 0.5f) & (b >= -0.5f) & (b < 0.5f);
  return inside ? (vfloat)(1.0f) : (vfloat)(0.0f);
#endif
}

// A direction on the unit circle for all 32-bit numbers: a quadrant and an angle within 45 degrees
// of its middle.
WIDE void onCircle(vuint h, vfloat* x, vfloat* y) {
  const vfloat a = toFloat(bitsToInt(h << 2)) * (0x1p-31f * 0.78539816f), s = a * a;
  const vfloat sine =
      a *
      (1.0f + s * (-0.16666667f + s * (0.0083333333f + s * (-1.9841270e-4f + s * 2.7557319e-6f))));
  const vfloat cosine =
      1.0f + s * (-0.5f + s * (0.041666667f + s * (-0.0013888889f + s * 2.4801587e-5f)));
  const vmask swap = (h & (1u << 30)) != 0u, turn = (h & (1u << 31)) != 0u;
  const vfloat c = swap ? -sine : cosine, d = swap ? cosine : sine;
  *x = turn ? -c : c;
  *y = turn ? -d : d;
}

// exp(-x) for 0 <= x < 80: a power of two and Taylor's sum of half a binary order. PoCL's exp()
// takes as long as all the rest.
WIDE vfloat expOfMinus(vfloat x) {
  const vfloat t = x * 1.44269504f;
  const vint whole = toInt(t + 0.5f);
  const vfloat f = (toFloat(whole) - t) * 0.69314718f;
  const vfloat sum =
      1.0f +
      f * (1.0f + f * (0.5f + f * (0.16666667f +
                                   f * (0.041666667f + f * (0.0083333333f + f * 0.0013888889f)))));
  return sum * bitsToFloat((127 - whole) << 23);
}

// Beyond this many squared alphas a lobe is below 1e-10 of its peak.
#define LOBE_END 23.0f

// D_l(h - m) / D_l(0) of microdetails with slopes (u, v), summed over the light's half vectors.
WIDE vfloat mirrored(vfloat u, vfloat v, constant const MicrodetailField* field,
                     global const float4* taps) {
  vfloat sum = (vfloat)(0.0f);
  for (uint t = 0; t < field->tap_count; ++t) {
    const float4 tap = taps[t];
    const vfloat x = (tap.x - u) * field->per_alpha_l.x, y = (tap.y - v) * field->per_alpha_l.y;
    const vfloat far = x * x + y * y;
    const vmask near = far < LOBE_END;
    if (anyLane(near)) sum += near ? tap.z * expOfMinus(far) : (vfloat)(0.0f);
  }
  return sum;
}

// What the kernel reads beside the pixels.
typedef struct {
  constant const MicrodetailField* field;
  global const uint* counts;
  global const float4* taps;
  global const float* sizes;
  global const float4* colours;
} Surface;

// What a pixel sees: by lobes and by chance, r, g, b.
typedef struct {
  vfloat lobes[3], reflecting[3];
} PixelSums;

// Microdetails that mirror some of the light are added, each in its size and colour.
WIDE void addMirroring(PixelSums* sums, vfloat weight, vfloat share, FourNumbers marks,
                       const Surface* surface) {
  // [ZK16] Eq. 7: what mirrors a share of the light mirrors all of it with that probability.
  const vmask chosen = unitInterval(marks.a) < share;
#if MARKED
  vfloat rgb[3];
  for (int l = 0; l < WIDTH; ++l) {
    const uint size_at = mul_hi(LANE(uint, marks.b, l), surface->field->size_count);
    const uint colour_at = mul_hi(LANE(uint, marks.c, l), surface->field->colour_count);
    const float size = surface->sizes[size_at];
    const float4 colour = surface->colours[colour_at];
    LANE(float, rgb[0], l) = size * colour.x;
    LANE(float, rgb[1], l) = size * colour.y;
    LANE(float, rgb[2], l) = size * colour.z;
  }
#endif
  for (int c = 0; c < (MARKED ? 3 : 1); ++c) {
#if MARKED
    const vfloat seen = weight * rgb[c];
#else
    const vfloat seen = weight;
#endif
    sums->lobes[c] += seen * share;
    sums->reflecting[c] += chosen ? seen : (vfloat)(0.0f);
  }
}

// The microdetails of one cell, `corner` from the pixel's centre.
WIDE void addCell(PixelSums* sums, const CellPixel* p, const Surface* surface, uint u, uint v,
                  float2 corner, uint details) {
  constant const MicrodetailField* field = surface->field;
  const vuint lane = laneNumbers();
  for (uint n = 0; n < details; n += WIDTH) {
    const vuint number = n + lane;
    const FourNumbers drawn = hashed((vuint)(u), (vuint)(v), number, field->seed);
    const vfloat place_u = corner.x + unitInterval(drawn.a);
    const vfloat place_v = corner.y + unitInterval(drawn.b);
    const vfloat weight = number < details ? filterWeight(p, place_u, place_v) : (vfloat)(0.0f);
    if (!anyLane(weight > 0.0f)) continue;
    // A slope of D_m: the square of its length in alphas has an exponential distribution.
    vfloat slope_u, slope_v;
    onCircle(drawn.d, &slope_u, &slope_v);
    const vfloat length = sqrt(max(-log(unitInterval(drawn.c) + 0x1p-33f), (vfloat)(0.0f)));
    slope_u *= length * field->alpha_m.x;
    slope_v *= length * field->alpha_m.y;
    const vfloat share = mirrored(slope_u, slope_v, field, surface->taps);
    if (!anyLane((share > 0.0f) & (weight > 0.0f))) continue;
    const FourNumbers marks = hashed((vuint)(u), (vuint)(v), number, field->seed ^ MARK_SEED);
    addMirroring(sums, weight, share, marks, surface);
  }
}

// A work-item sums one pixel, `first` and following of `stride`. `colours` and `sizes` are read if
// MARKED.
WIDE_KERNEL void placeDetails(global const uint* pixels, constant const MicrodetailField* field,
                              global const uint* counts, global const float4* taps,
                              global const float* sizes, global const float4* colours,
                              global float* sums_out, uint stride, uint first, uint count) {
  if (get_global_id(0) >= count) return;
  const uint entry = first + (uint)get_global_id(0);
  const Surface surface = {field, counts, taps, sizes, colours};
  const CellPixel p = cellPixel(pixels, stride, entry, field->cell_level);
  const float reach = TENT ? 1.0f : 0.5f;
  const float half_v = reach * (fabs(p.edge_x.y) + fabs(p.edge_y.y));
  const int bottom = (int)floor(p.centre.y - half_v), top = (int)floor(p.centre.y + half_v);
  PixelSums sums;
  for (int c = 0; c < 3; ++c) sums.lobes[c] = sums.reflecting[c] = (vfloat)(0.0f);

  for (int row = bottom; row <= top; ++row) {
    const uint v = p.cell_v + (uint)row;
    const float2 range = rowRange(&p, reach, (float)row);
    // A little more than the range: rounding loses no cell, and the filter decides what counts.
    const int left = (int)floor(range.x - 1e-3f), right = (int)floor(range.y + 1e-3f);
    for (int some = left; some <= right; some += WIDTH) {
      const vuint columns = p.cell_u + (uint)some + laneNumbers();
      vuint hashes = hashed(columns, (vuint)(v), (vuint)(COUNT_NUMBER), field->seed).a;
      for (int l = 0; l < WIDTH && some + l <= right; ++l) {
        const float2 corner = (float2)((float)(some + l), (float)row) - p.centre;
        addCell(&sums, &p, &surface, p.cell_u + (uint)(some + l), v, corner,
                detailCount(counts, LANE(uint, hashes, l)));
      }
    }
  }
  for (uint c = 0; c < 3; ++c) {
    const uint from = MARKED ? c : 0u;
    sums_out[(MD_LOBES + c) * (size_t)stride + entry] = laneSum(sums.lobes[from]);
    sums_out[(MD_REFLECTING + c) * (size_t)stride + entry] = laneSum(sums.reflecting[from]);
  }
}
