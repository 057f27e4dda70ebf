// Scattering at a surface of Smith's theory: a walk through a volume of microfacets, whose heights
// are independent of their slopes and of one another. What the ray caster of heightfield.cl counts
// on real heights is counted here without any, in the same words.
//
// [Heitz 2016] Heitz, Hanika, d'Eon, Dachsbacher, "Multiple-Scattering Microfacet BSDFs with the
// Smith Model", SIGGRAPH 2016. A ray's height stands as the share C1 of heights below it, on which
// nothing depends but itself, so that no distribution of heights is chosen.
#include "config.clh"

// What the microfacets are: 0 diffuse, 1 metal.
#ifndef SURFACE_KIND
#define SURFACE_KIND 0
#endif
#if SURFACE_KIND != 0 && SURFACE_KIND != 1
#error "SURFACE_KIND must be 0 (diffuse) or 1 (metal)"
#endif

#include "scatter/height_bounce.clh"
#include "scatter/heightfield.h"
#include "scatter/outcome.clh"
#include "scatter/visible_slope.clh"
#include "types.h"
#include "wide/wide_memory.clh"

// One ray per lane.
typedef struct {
  vfloat3 direction;  // real space, unit
  vfloat below;       // share of heights below the ray, (0, 1]
  vint order;         // bounces so far
  vuint random;
  vmask alive;
} Walk;

// The facet that a ray meets: one of those that it sees. Real space, unit, towards the ray.
WIDE vfloat3 metNormal(Walk* walk, constant const HeightfieldRun* run) {
  const vfloat3 from = scale3(walk->direction, (vfloat)(-1.0f));
  // Where the roughness is 1 along both axes slopes are as many in all directions.
  const vfloat x = from.x * run->alpha.x, y = from.y * run->alpha.y;
  const vfloat across_sq = fma(x, x, y * y);
  const vfloat inverse = wideRsqrt(max(across_sq, (vfloat)(1e-20f)));
  // Straight on any direction across serves.
  const vfloat c = across_sq > 1e-20f ? x * inverse : (vfloat)(1.0f), s = y * inverse;
  const vfloat along = visibleSlope(signedCotangent(from, run->alpha), &walk->random, walk->alive);
  const vfloat beside = gaussianSlope(&walk->random, walk->alive);
  const vfloat3 n = {-run->alpha.x * fma(along, c, -(beside * s)),
                     -run->alpha.y * fma(along, s, beside * c), (vfloat)(1.0f)};
  return normalize3(n);
}

// Flies the rays to where they meet a facet; returns those that leave instead. Heights C1 above
// which a ray's way out is free are met with the probability C1^Lambda.
WIDE vmask flyOn(Walk* walk, constant const HeightfieldRun* run) {
  const vfloat lambda = signedLambda(signedCotangent(walk->direction, run->alpha));
  vuint random = walk->random;
  const vfloat u = nextRandom(&random) + 0x1p-25f;
  walk->random = walk->alive ? random : walk->random;
  const vfloat log_below = wideLog2(max(walk->below, (vfloat)(1e-30f)));
  const vfloat log_u = wideLog2(u);
  const vmask leaves = walk->alive & (walk->direction.z > 0.0f) & (log_u <= log_below * lambda);
  const vfloat safe = fabs(lambda) > 1e-6f ? lambda : (vfloat)(1e-6f);
  const vfloat log_met = min(log_below - log_u / safe, (vfloat)(0.0f));
  walk->below = (walk->alive & !leaves) ? wideExp2(log_met) : walk->below;
  return leaves;
}

WIDE void meetFacet(Walk* walk, constant const HeightfieldRun* run, vmask which, vint* word,
                    vmask* absorbed) {
  const vfloat3 n = metNormal(walk, run);
  vuint random = walk->random;
  vfloat3 after;
  *absorbed = (vint)(0);
#if SURFACE_KIND == 0
  after = scatterDiffuse(n, &random);
#else
  after = mirror(walk->direction, n);
  const vfloat cosine = clamp(-dot3(walk->direction, n), (vfloat)(0.0f), (vfloat)(1.0f));
  const vfloat reflectance = metalReflectance(cosine, run);
  *absorbed = which & (nextRandom(&random) >= reflectance);
  *word = (int)HF_ABSORBED + walk->order;
#endif
  walk->random = which ? random : walk->random;
  walk->direction.x = which ? after.x : walk->direction.x;
  walk->direction.y = which ? after.y : walk->direction.y;
  walk->direction.z = which ? after.z : walk->direction.z;
  walk->order += which ? (vint)(1) : (vint)(0);
}

// One work-item walks WIDTH * run->rays_per_lane rays, as far as there are `ray_count` in all.
// `seed`: of this launch. outcomes: as of heightfield.cl.
WIDE_KERNEL void walkRays(constant const HeightfieldRun* run, uint seed, uint ray_count,
                          global uint* outcomes) {
  const uint item_rays = (uint)WIDTH * run->rays_per_lane;
  for (uint k = 0; k < run->rays_per_lane; ++k) {
    const vuint id = laneNumbers() + ((uint)get_global_id(0) * item_rays + k * (uint)WIDTH);
    Walk walk;
    walk.random = rayRandom(id, seed);
    walk.direction = broadcast3(run->incoming);
    walk.below = (vfloat)(1.0f);
    walk.order = (vint)(0);
    walk.alive = id < ray_count;
    while (anyLane(walk.alive)) {
      const vmask leaves = flyOn(&walk, run);
      const vmask spent = walk.alive & !leaves & (walk.order >= (int)run->orders);
      vint word = leavingCell(walk.direction, walk.order - 1);
      word = spent ? (vint)((int)HF_LEFT_OVER) : word;
      vmask ended = leaves | spent;
      const vmask meets = walk.alive & !ended;
      vint end_word = (vint)(0);
      vmask absorbed;
      meetFacet(&walk, run, meets, &end_word, &absorbed);
      word = absorbed ? end_word : word;
      ended = ended | absorbed;
      if (anyLane(ended)) writeOutcome(outcomes, bitsToInt(id), ray_count, word, ended);
      walk.alive = walk.alive & !ended;
    }
  }
}
