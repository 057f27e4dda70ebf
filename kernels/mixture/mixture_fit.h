// What the fit of Gaussian mixtures shares between host and kernels. Preprocessor constants and one
// struct only; rules as in types.h. [TAN05] Sect. 4.1
#ifndef GLINTMARK_MIXTURE_FIT_H
#define GLINTMARK_MIXTURE_FIT_H

// A texel begins with its parent's lobes; their weights are mixed with equal ones by this share, so
// that a lobe the parent hardly uses can come back.
#define MF_START_MIX 0.5f
// Fitted lobes below this weight are given up: their normals go to the others.
#define MF_LEAST_WEIGHT 1e-3f
// A lobe's variance while it is fitted is at least this, so that densities stay finite: a deviation
// of 0.01 is below that of any surface the kernels shade. What is stored is not bounded.
#define MF_MIN_VARIANCE 1e-4f
// EM steps of the coarsest level, whose lobes all others begin with.
#define MF_ROOT_ITERATIONS 64
// Normals that a clustered start looks at.
#define MF_START_NORMALS 4096

// Where a texel's rows of normals are at least as long as this, lanes hold normals, not texels.
// Normals are then summed up in as many slots, whatever the lane count, and the slots are added in
// one order: the same bits at every lane count and however work-items are scheduled.
#define MF_SLOTS 16
// Numbers that an E-step adds up for a texel: four per lobe, and the likelihood.
#define MF_SUMS(lobes) (4 * (lobes) + 1)

// One launch: a colour batch of one level, texels (origin_x + 2 i, origin_y + 2 j).
typedef struct MixtureFitRun {
  int first, width, height;        // the level: its first texel in the chain, its size
  int parent_first, parent_width;  // the level above; width 0: there is none
  int parent_height;
  int finer_first, finer_width;  // the level below; width 0: not to be seen
  int finer_height;
  int map_width, map_height;              // the finest normals
  int most_columns;                       // of normals under one texel
  int origin_x, origin_y, columns, rows;  // the batch
  int items_per_row;                      // work-items of one of its rows
  int rows_per_chunk, chunks;             // rows of normals that are summed up together, where long
  int max_iterations;
  int first_sweep;  // 1: of its own level a texel sees earlier colours only
  int from_parent;  // 1: begins with the parent's lobes, 0: with its own
  float prior_weight, tolerance;
  float normals;  // total weight of a texel's normals
  int unused[3];  // to a multiple of 16 bytes
} MixtureFitRun;

#endif
