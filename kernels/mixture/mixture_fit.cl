// Fits Gaussian mixtures to the normals under every texel of a mip chain. [TAN05] Sect. 4.1
//
// The host (host/mixture/device_mixture_fit.cpp) launches one colour batch of a level after the
// other. Two ways to fill lanes. Where texels have few normals, a lane is a texel and fitTexels
// takes all its EM steps. Where rows of normals are long, a lane is a normal: a step is expectRows
// (partial sums over chunks of rows), addPartials, maximizeTexels.
#include "mixture/mixture_cover.clh"
#include "mixture/mixture_texels.clh"

#define SUMS MF_SUMS(LOBES)

#if WIDTH > 1
// Normals that a work-item of several lanes keeps beside each other from one EM step to the next.
#define KEPT_NORMALS 64
typedef struct {
  vfloat x[KEPT_NORMALS], y[KEPT_NORMALS], weight[KEPT_NORMALS];
} KeptNormals;
#else
typedef int KeptNormals;
#endif

// The normals under the texels of a work-item: `rows` rows of most_columns each.
typedef struct {
  vint x, first;  // the texel, its first column
  int y, first_row, rows;
} Covered;

WIDE Covered coveredNormals(constant const MixtureFitRun* run, const TexelLanes* t) {
  Covered c;
  c.x = t->x;
  c.y = t->y;
  c.first = coverFirstLanes(t->x, run->width, run->map_width);
  c.first_row = coverFirst(t->y, run->height, run->map_height);
  c.rows = coverEnd(t->y, run->height, run->map_height) - c.first_row;
  return c;
}

// Where a walk over those normals, row by row, has come to.
typedef struct {
  int row, column;  // from the first
  float row_weight;
} NormalCursor;

WIDE void startRow(constant const MixtureFitRun* run, const Covered* c, NormalCursor* at, int row) {
  at->row = row;
  at->column = 0;
  at->row_weight = coverWeightScalar(c->first_row + row, c->y, run->height, run->map_height);
}

// The next normal of each lane; those beyond a texel's own have weight 0.
WIDE void nextNormal(constant const MixtureFitRun* run, global const float* normal_x,
                     global const float* normal_y, const Covered* c, NormalCursor* at, vfloat* x,
                     vfloat* y, vfloat* weight) {
  const vint column = c->first + at->column;
  const vint place = (c->first_row + at->row) * run->map_width + column;
  *x = gatherFloat(normal_x, place);
  *y = gatherFloat(normal_y, place);
  *weight = (vfloat)(at->row_weight);
  if (run->most_columns * run->width != run->map_width)
    *weight *= coverWeight(column, c->x, run->width, run->map_width);
  if (++at->column == run->most_columns) startRow(run, c, at, at->row + 1);
}

// E-step over all normals. kept: the normals of the last step, if all have room there and `again`.
WIDE MixtureSums expectTexels(constant const MixtureFitRun* run, global const float* normal_x,
                              global const float* normal_y, const Covered* c, const Mixture* m,
                              KeptNormals* kept, int again, const int likelihood) {
  const MixtureDensity density = densityOf(m);
  MixtureSums sums = noSums();
  const int normals = c->rows * run->most_columns;
  NormalCursor at;
  startRow(run, c, &at, 0);
#if WIDTH > 1
  for (int begin = 0; begin < normals; begin += KEPT_NORMALS) {
    const int count = min(normals - begin, KEPT_NORMALS);
    if (!again || normals > KEPT_NORMALS) {
      for (int j = 0; j < count; ++j)
        nextNormal(run, normal_x, normal_y, c, &at, &kept->x[j], &kept->y[j], &kept->weight[j]);
    }
    for (int j = 0; j < count; ++j)
      addNormal(&sums, &density, kept->x[j], kept->y[j], kept->weight[j], likelihood);
  }
#else
  for (int j = 0; j < normals; ++j) {
    vfloat x, y, weight;
    nextNormal(run, normal_x, normal_y, c, &at, &x, &y, &weight);
    addNormal(&sums, &density, x, y, weight, likelihood);
  }
#endif
  return sums;
}

// All EM steps of WIDTH texels. normal_x, normal_y: the map, MF_SLOTS readable beyond its end.
// tally: 64 pairs (EM steps, texels that came to rest), added to.
WIDE_KERNEL void fitTexels(global const float* normal_x, global const float* normal_y,
                           constant const MixtureFitRun* run, global float* state,
                           global uint* tally) {
  const int item = (int)get_global_id(0);
  if (item >= run->rows * run->items_per_row) return;
  const TexelLanes texels = texelLanes(run, item);
  const Covered covered = coveredNormals(run, &texels);
  Mixture mixture = startMixture(run, state, &texels);
  const MixturePrior prior = neighbourPrior(run, state, &texels);
  KeptNormals kept;
  vmask active = texels.x >= 0;
  int steps = 0;
  for (int step = 0; step < run->max_iterations && anyLane(active); ++step) {
    const MixtureSums sums =
        expectTexels(run, normal_x, normal_y, &covered, &mixture, &kept, step > 0, 0);
    const vfloat moved = maximize(&mixture, &prior, &sums, run->normals, active);
    steps += countLanes(active & texels.within);
    active = active & (moved >= run->tolerance);
  }
  storeMixture(&mixture, state, texelIndex(run, &texels));
  const int resting = countLanes(texels.within) - countLanes(active & texels.within);
  atomic_add(&tally[2 * (item & 63)], (uint)steps);
  atomic_add(&tally[2 * (item & 63) + 1], (uint)resting);
}

// One more E-step, and moments in place of lobes. likelihood: a number per texel of the level, the
// sum over its normals of the logarithm of the density.
WIDE_KERNEL void finishTexels(global const float* normal_x, global const float* normal_y,
                              constant const MixtureFitRun* run, global float* state,
                              global float* likelihood) {
  const int item = (int)get_global_id(0);
  if (item >= run->rows * run->items_per_row) return;
  const TexelLanes texels = texelLanes(run, item);
  const Covered covered = coveredNormals(run, &texels);
  Mixture mixture = loadMixture(state, texelIndex(run, &texels));
  dropFaintLobes(&mixture);
  KeptNormals kept;
  const MixtureSums sums = expectTexels(run, normal_x, normal_y, &covered, &mixture, &kept, 0, 1);
  storeMoments(run, &texels, &mixture, &sums, state, likelihood);
}

// Where rows are long: the texels' first lobes go to `state`, their priors to `prior`, a number per
// lobe, component and texel of the batch. status: per texel of the batch twice the EM steps it has
// taken, plus 1 while it moves.
WIDE_KERNEL void startTexels(constant const MixtureFitRun* run, global float* state,
                             global float* prior_sums, global uint* status) {
  const int item = (int)get_global_id(0);
  if (item >= run->rows * run->items_per_row) return;
  const TexelLanes texels = texelLanes(run, item);
  const Mixture mixture = startMixture(run, state, &texels);
  const MixturePrior prior = neighbourPrior(run, state, &texels);
  const int count = run->rows * run->columns;
  EACH_LOBE(i) {
    scatterFloat(prior.weight[i], prior_sums + 3 * i * count, texels.number);
    scatterFloat(prior.x[i], prior_sums + (3 * i + 1) * count, texels.number);
    scatterFloat(prior.y[i], prior_sums + (3 * i + 2) * count, texels.number);
  }
  storeMixture(&mixture, state, texelIndex(run, &texels));
  scatterUint((vuint)(1u), status, texels.number);
}

// E-step over one chunk of rows of one texel, lanes being slots of neighbouring columns.
WIDE MixtureSums expectChunk(constant const MixtureFitRun* run, global const float* normal_x,
                             global const float* normal_y, int x, int y, int chunk, int slot,
                             const Mixture* m, const int likelihood) {
  const MixtureDensity density = densityOf(m);
  MixtureSums sums = noSums();
  const int first = coverFirst(x, run->width, run->map_width);
  const int end = coverEnd(x, run->width, run->map_width);
  const int begin_row = coverFirst(y, run->height, run->map_height) + chunk * run->rows_per_chunk;
  const int end_row =
      min(begin_row + run->rows_per_chunk, coverEnd(y, run->height, run->map_height));
  for (int row = begin_row; row < end_row; ++row) {
    const float row_weight = coverWeightScalar(row, y, run->height, run->map_height);
    for (int column = first + slot; column < end; column += MF_SLOTS) {
      const vint columns = bitsToInt(laneNumbers()) + column;
      const vfloat weight =
          row_weight * coverWeight(columns, (vint)(x), run->width, run->map_width);
      const size_t at = (size_t)row * run->map_width + column;
      addNormal(&sums, &density, bitsToFloat(loadUint((global const uint*)normal_x, at)),
                bitsToFloat(loadUint((global const uint*)normal_y, at)), weight, likelihood);
    }
  }
  return sums;
}

// partials: for each texel of the batch, chunk and sum MF_SLOTS numbers. One work-item per texel,
// chunk and WIDTH slots. finishing: lobes that are given up take no part, the likelihood counts,
// and texels at rest take part.
WIDE_KERNEL void expectRows(global const float* normal_x, global const float* normal_y,
                            constant const MixtureFitRun* run, global const float* state,
                            global const uint* status, uint finishing, global float* partials) {
  const int groups = MF_SLOTS / WIDTH;
  const int item = (int)get_global_id(0);
  if (item >= run->rows * run->columns * run->chunks * groups) return;
  const int slot = item % groups * WIDTH, part = item / groups;
  const int chunk = part % run->chunks, texel = part / run->chunks;
  if (!finishing && !(status[texel] & 1u)) return;
  const int x = run->origin_x + 2 * (texel % run->columns);
  const int y = run->origin_y + 2 * (texel / run->columns);
  global const float4* lobes =
      (global const float4*)state + (size_t)(run->first + y * run->width + x) * LOBES;
  Mixture mixture;
  EACH_LOBE(i) {
    const float4 lobe = lobes[i];
    mixture.weight[i] = (vfloat)(lobe.x);
    mixture.x[i] = (vfloat)(lobe.y);
    mixture.y[i] = (vfloat)(lobe.z);
    mixture.variance[i] = (vfloat)(lobe.w);
  }
  MixtureSums sums;
  if (finishing) {
    dropFaintLobes(&mixture);
    sums = expectChunk(run, normal_x, normal_y, x, y, chunk, slot, &mixture, 1);
  } else {
    sums = expectChunk(run, normal_x, normal_y, x, y, chunk, slot, &mixture, 0);
  }
  global float* to = partials + (size_t)part * SUMS * MF_SLOTS + slot;
  EACH_LOBE(i) {
    storeFloat(sums.count[i], to, (4 * i) * MF_SLOTS);
    storeFloat(sums.x[i], to, (4 * i + 1) * MF_SLOTS);
    storeFloat(sums.y[i], to, (4 * i + 2) * MF_SLOTS);
    storeFloat(sums.squares[i], to, (4 * i + 3) * MF_SLOTS);
  }
  storeFloat(sums.log2_likelihood, to, 4 * LOBES * MF_SLOTS);
}

// sums: a number per sum and texel of the batch. One work-item each; the same order of addition at
// every lane count.
WIDE_KERNEL void addPartials(constant const MixtureFitRun* run, global const float* partials,
                             global float* sums) {
  const int count = run->rows * run->columns;
  const int item = (int)get_global_id(0);
  if (item >= count * SUMS) return;
  const int texel = item / SUMS, sum = item % SUMS;
  global const float* from = partials + ((size_t)texel * run->chunks * SUMS + sum) * MF_SLOTS;
  float16 slots = 0.0f;
  for (int chunk = 0; chunk < run->chunks; ++chunk) slots += vload16((size_t)chunk * SUMS, from);
  const float8 eight = slots.lo + slots.hi;
  const float4 four = eight.lo + eight.hi;
  const float2 two = four.lo + four.hi;
  sums[sum * count + texel] = two.x + two.y;
}

WIDE MixtureSums loadSums(global const float* from, int count, vint texel) {
  MixtureSums s;
  EACH_LOBE(i) {
    s.count[i] = gatherFloat(from + (4 * i) * count, texel);
    s.x[i] = gatherFloat(from + (4 * i + 1) * count, texel);
    s.y[i] = gatherFloat(from + (4 * i + 2) * count, texel);
    s.squares[i] = gatherFloat(from + (4 * i + 3) * count, texel);
  }
  s.log2_likelihood = gatherFloat(from + 4 * LOBES * count, texel);
  return s;
}

// M-step of WIDTH texels.
WIDE_KERNEL void maximizeTexels(constant const MixtureFitRun* run, global const float* sums,
                                global const float* prior_sums, global float* state,
                                global uint* status) {
  const int item = (int)get_global_id(0);
  if (item >= run->rows * run->items_per_row) return;
  const TexelLanes texels = texelLanes(run, item);
  const int count = run->rows * run->columns;
  const vint at = texelIndex(run, &texels);
  const vuint before = gatherUint(status, texels.number);
  const vmask active = (before & 1u) != 0u;
  if (!anyLane(active)) return;
  Mixture mixture = loadMixture(state, at);
  MixturePrior prior;
  EACH_LOBE(i) {
    prior.weight[i] = gatherFloat(prior_sums + 3 * i * count, texels.number);
    prior.x[i] = gatherFloat(prior_sums + (3 * i + 1) * count, texels.number);
    prior.y[i] = gatherFloat(prior_sums + (3 * i + 2) * count, texels.number);
  }
  const MixtureSums s = loadSums(sums, count, texels.number);
  const vfloat moved = maximize(&mixture, &prior, &s, run->normals, active);
  storeMixture(&mixture, state, at);
  const vuint after = moved >= run->tolerance ? before + 2u : (before & ~1u) + 2u;
  scatterUint(active ? after : before, status, texels.number);
}

// Moments in place of lobes, where rows are long.
WIDE_KERNEL void finishRows(constant const MixtureFitRun* run, global const float* sums,
                            global float* state, global float* likelihood) {
  const int item = (int)get_global_id(0);
  if (item >= run->rows * run->items_per_row) return;
  const TexelLanes texels = texelLanes(run, item);
  Mixture mixture = loadMixture(state, texelIndex(run, &texels));
  dropFaintLobes(&mixture);
  const MixtureSums s = loadSums(sums, run->rows * run->columns, texels.number);
  storeMoments(run, &texels, &mixture, &s, state, likelihood);
}
