// Brute-force scattering: rays fly at a rough surface, bounce, and are counted where they leave.
// [PAT18] "Using Brute Force Ray-Casting"
//
// A lane takes one ray after another. Rays that meet a face or leave wait until SOME_WAIT of their
// neighbours do, so that the long branches serve many lanes at once. Every ray has random numbers
// and an outcome of its own: results depend on neither lanes nor scheduling.
#include "config.clh"

// What the microfacets are: 0 diffuse, 1 metal, 2 dielectric.
#ifndef SURFACE_KIND
#define SURFACE_KIND 0
#endif
#if SURFACE_KIND != 0 && SURFACE_KIND != 1 && SURFACE_KIND != 2
#error "SURFACE_KIND must be 0 (diffuse), 1 (metal) or 2 (dielectric)"
#endif
#define REFRACTION (SURFACE_KIND == 2)

// 1: rays leave after the last bounce whether or not the surface is in their way.
#ifndef LAST_BOUNCE_LEAVES
#define LAST_BOUNCE_LEAVES 0
#endif
#if LAST_BOUNCE_LEAVES != 0 && LAST_BOUNCE_LEAVES != 1
#error "LAST_BOUNCE_LEAVES must be 0 or 1"
#endif

#include "scatter/height_bounce.clh"
#include "scatter/height_walk.clh"
#include "scatter/outcome.clh"
#include "wide/wide_exchange.clh"

// Waiting rays that end a round of flying.
#if WIDTH == 1
#define SOME_WAIT 1
#elif !defined(SOME_WAIT)
#define SOME_WAIT (WIDTH * 5 / 8)
#endif

// Groups of lanes that fly in turn: while one waits for memory another computes. Two of them change
// lanes where they can, until all of one wait and are served together.
#ifndef GROUPS
#define GROUPS (WIDTH == 1 ? 1 : 2)
#endif

// One ray per lane.
typedef struct {
  Ray ray;
  vint side;          // +1 above the surface, -1 below
  vint order;         // bounces so far
  vint steps;         // cells and jumps before this flight
  vuint random;       // the ray's sequence
  vuint id;           // the ray's number in this launch
  vint left;          // rays that the lane has still to start
  vmask alive;        // the lane has a ray,
  vmask flying, met;  // which flies, has met a face, or, neither, leaves
  int alive_count;
  int steps_done;  // by the lanes together
} Flight;

// Direction in real space, unit.
WIDE vfloat3 realDirection(const Flight* f, constant const HeightfieldRun* run) {
  vfloat3 d = {f->ray.dx / run->alpha.x, f->ray.dy / run->alpha.y, f->ray.dz * run->count_height};
#if REFRACTION
  d.z *= toFloat(f->side);
#endif
  return normalize3(d);
}

// Sets the direction of the lanes of `which` from real space.
WIDE void setDirection(Flight* f, vfloat3 d, constant const HeightfieldRun* run, vmask which) {
  vfloat dz = d.z * (1.0f / run->count_height);
#if REFRACTION
  dz *= toFloat(f->side);
#endif
  setFlight(&f->ray, d.x * run->alpha.x, d.y * run->alpha.y, dz, f->side, which);
}

// The histogram's word of rays that leave.
WIDE vint leavingWord(const Flight* f, constant const HeightfieldRun* run) {
  const vfloat3 d = realDirection(f, run);
  vint block = f->order - 1;
#if REFRACTION
  block += f->side < 0 ? (vint)((int)HF_MAX_ORDERS) : (vint)(0);
#endif
  return leavingCell(d, block);
}

// The lanes of `which` take their next ray, or none if none is left; returns those that have one.
// Its direction is still to be set. Rays come in from above the
// highest height and would cross the mean plane anywhere in the tile, but those of neighbouring
// numbers in one window of it, so that their flights share a small part of the maps.
WIDE vmask startRays(Flight* f, constant const HeightfieldRun* run, uint seed, uint ray_count,
                     vmask which) {
  Ray* r = &f->ray;
  const vmask starting = which & (f->left > 0);
  f->left -= starting ? (vint)(1) : (vint)(0);
  f->id += starting ? (vuint)((uint)(WIDTH * GROUPS)) : (vuint)(0u);
  vuint random = rayRandom(f->id, seed);
  const vint window =
      toInt(toFloat(bitsToInt(f->id)) * ((float)(HF_WINDOWS * HF_WINDOWS) / (float)ray_count));
  const float window_texels = (float)(HF_TILE / HF_WINDOWS);
  vfloat x = (toFloat(window & (int)(HF_WINDOWS - 1)) + nextRandom(&random)) * window_texels;
  vfloat y = (toFloat(window >> HF_WINDOW_SHIFT) + nextRandom(&random)) * window_texels;
  const float descent = (float)HF_MOST_COUNTS * run->count_height / run->incoming.z;
  x += descent * run->incoming.x * run->alpha.x;
  y += descent * run->incoming.y * run->alpha.y;
  const vfloat cell_x = floor(x), cell_y = floor(y);
  f->random = starting ? random : f->random;
  r->x = starting ? toInt(cell_x) & TILE_MASK : r->x;
  r->y = starting ? toInt(cell_y) & TILE_MASK : r->y;
  r->u = starting ? x - cell_x : r->u;
  r->v = starting ? y - cell_y : r->v;
  r->z = starting ? (vfloat)((float)HF_MOST_COUNTS) : r->z;
  f->side = starting ? (vint)(1) : f->side;
  f->order = starting ? (vint)(0) : f->order;
  f->alive = (f->alive & !which) | starting;
  return starting;
}

// Sends the lanes of `which` off in a direction of real space; their rays are on or above the
// surface.
WIDE void takeOff(Flight* f, global const uint* cones, vfloat3 direction,
                  constant const HeightfieldRun* run, vmask which) {
  setDirection(f, direction, run, which);
  const vmask out = jumpAhead(cones, &f->ray, which);
  f->met = f->met & !which;
  f->flying = (f->flying & !which) | (which & !out);
  f->steps = which ? (vint)(f->steps_done) : f->steps;
}

// One cell and one jump of the flying lanes.
WIDE void fly(Flight* f, global const uint* heights, global const uint* cones) {
  const CellFaces faces = cellFaces(heights, &f->ray, f->side);
  const CellCrossing crossing = crossCell(&f->ray);
  const vmask hit =
      (meetsFirst(&f->ray, &faces, &crossing) | meetsSecond(&f->ray, &faces, &crossing)) &
      f->flying;
  f->met = f->met | hit;
  f->flying = f->flying & !hit;
  enterNextCell(&f->ray, &crossing, f->flying);
  f->flying = f->flying & !jumpAhead(cones, &f->ray, f->flying);
  f->steps_done += 1;
}

// Flight of the lanes of `which` up to the face that they met; returns its normal, unit, on their
// side.
WIDE vfloat3 land(Flight* f, global const uint* heights, constant const HeightfieldRun* run,
                  vmask which) {
  Ray* r = &f->ray;
  const CellFaces faces = cellFaces(heights, r, f->side);
  const CellCrossing crossing = crossCell(r);
  const vmask first = meetsFirst(r, &faces, &crossing);
  const vfloat slope_u = first ? faces.first_u : faces.second_u;
  const vfloat slope_v = first ? faces.first_v : faces.second_v;
  const vfloat begin = first ? (vfloat)(0.0f) : crossing.first_end;
  const vfloat end = first ? crossing.first_end : crossing.end;
  const vfloat rate = min(clearanceRate(r, slope_u, slope_v), (vfloat)(-1e-30f));
  const vfloat flight =
      clamp(clearance(r, faces.height, slope_u, slope_v) * wideReciprocal(-rate), begin, end);
  const vfloat u = clamp(fma(flight, r->dx, r->u), (vfloat)(0.0f), (vfloat)(1.0f));
  const vfloat v = clamp(fma(flight, r->dy, r->v), (vfloat)(0.0f), (vfloat)(1.0f));
  r->u = which ? u : r->u;
  r->v = which ? v : r->v;
  r->z = which ? fma(slope_u, u, fma(slope_v, v, faces.height)) : r->z;
  const vfloat3 n = {slope_u * (-run->count_height * run->alpha.x),
                     slope_v * (-run->count_height * run->alpha.y), toFloat(f->side)};
  return normalize3(n);
}

// Bounces the lanes of `which` off the face that they met, or into it: *after is their new
// direction in real space. Returns the lanes whose rays end here and their histogram words.
WIDE vmask bounce(Flight* f, global const uint* heights, constant const HeightfieldRun* run,
                  vmask which, vint* word, vfloat3* after) {
  const vfloat3 n = land(f, heights, run, which);
  vuint random = f->random;
  vmask ended = (vint)(0);
#if SURFACE_KIND == 0
  *after = scatterDiffuse(n, &random);
#elif SURFACE_KIND == 1
  const vfloat3 before = realDirection(f, run);
  *after = mirror(before, n);
  const vfloat cosine = clamp(-dot3(before, n), (vfloat)(0.0f), (vfloat)(1.0f));
  const vfloat reflectance = metalReflectance(cosine, run);
  ended = which & (nextRandom(&random) >= reflectance);
  *word = (int)HF_ABSORBED + f->order;
#else
  const vfloat3 before = realDirection(f, run);
  const vfloat ratio = f->side > 0 ? (vfloat)(run->index_n) : (vfloat)(1.0f / run->index_n);
  vmask refracted;
  *after = scatterDielectric(before, n, ratio, &random, &refracted);
  refracted = refracted & which;
  f->side = refracted ? -f->side : f->side;
  f->ray.z = refracted ? -f->ray.z : f->ray.z;
#endif
  f->random = which ? random : f->random;
  f->order += which ? (vint)(1) : (vint)(0);
  return ended;
}

// Serves the lanes that wait: new directions, outcomes, new rays.
WIDE void serve(Flight* f, global const uint* heights, global const uint* cones,
                constant const HeightfieldRun* run, uint seed, uint ray_count,
                global uint* outcomes) {
  const vmask out = f->alive & !(f->flying | f->met);
  const vmask stuck = f->flying & ((vint)(f->steps_done) - f->steps > HF_MOST_STEPS);
  const vmask spent = f->met & (f->order >= (int)run->orders);
  vint word = stuck ? (vint)((int)HF_GAVE_UP) : leavingWord(f, run);
  word = spent ? (vint)((int)HF_LEFT_OVER) : word;
  vmask ended = out | stuck | spent;
  vmask bouncing = f->met & !spent;
  vfloat3 direction = broadcast3(run->incoming);
  if (anyLane(bouncing)) {
    vfloat3 after;
    vint end_word = (vint)(0);
    const vmask here = bounce(f, heights, run, bouncing, &end_word, &after);
    word = here ? end_word : word;
    ended = ended | here;
    bouncing = bouncing & !here;
#if LAST_BOUNCE_LEAVES
    const vmask last = bouncing & (f->order >= (int)run->orders);
    setDirection(f, after, run, last);
    word = last ? leavingWord(f, run) : word;
    word = last & (f->ray.dz <= 0.0f) ? (vint)((int)HF_LEFT_OVER) : word;
    ended = ended | last;
    bouncing = bouncing & !last;
#endif
    direction.x = bouncing ? after.x : direction.x;
    direction.y = bouncing ? after.y : direction.y;
    direction.z = bouncing ? after.z : direction.z;
  }
  if (anyLane(ended)) writeOutcome(outcomes, bitsToInt(f->id), ray_count, word, ended);
  const vmask starting = startRays(f, run, seed, ray_count, ended);
  takeOff(f, cones, direction, run, starting | bouncing);
  f->flying = f->flying & f->alive;
  f->met = f->met & f->alive;
  f->alive_count = countLanes(f->alive);
}

// A lane's first ray has number `first` + its number; the next ones follow in steps of all lanes.
WIDE Flight makeFlight(constant const HeightfieldRun* run, uint first, uint ray_count) {
  Flight f;
  const vint none = (vint)(0);
  const vuint id = laneNumbers() + first;
  f.left = id < ray_count ? bitsToInt((ray_count - 1u - id) / (uint)(WIDTH * GROUPS)) + 1 : none;
  f.left = min(f.left, (vint)((int)run->rays_per_lane));
  f.id = id - (uint)(WIDTH * GROUPS);
  f.alive = f.flying = f.met = f.order = f.steps = f.side = none;
  f.steps_done = f.alive_count = 0;
  f.random = (vuint)(0u);
  f.ray.x = f.ray.y = none;
  f.ray.u = f.ray.v = f.ray.z = (vfloat)(0.0f);
  setFlight(&f.ray, f.ray.u, f.ray.v, f.ray.z, f.side, !none);
  return f;
}

#if CAN_EXCHANGE && GROUPS == 2
// Every lane of `waiting` that flies changes places with one of `flying` that does not, of which
// there must be as many. Both have done the same number of steps.
WIDE void gatherWaiting(Flight* waiting, Flight* flying) {
  const LaneExchange e = pairLanes(waiting->flying, !flying->flying);
  Ray *a = &waiting->ray, *b = &flying->ray;
  exchangeInts(e, &a->x, &b->x);
  exchangeInts(e, &a->y, &b->y);
  exchangeFloats(e, &a->u, &b->u);
  exchangeFloats(e, &a->v, &b->v);
  exchangeFloats(e, &a->z, &b->z);
  exchangeFloats(e, &a->dx, &b->dx);
  exchangeFloats(e, &a->dy, &b->dy);
  exchangeFloats(e, &a->dz, &b->dz);
  exchangeFloats(e, &a->inv_dx, &b->inv_dx);
  exchangeFloats(e, &a->inv_dy, &b->inv_dy);
  exchangeFloats(e, &a->inv_across, &b->inv_across);
  exchangeInts(e, &a->cone_map, &b->cone_map);
#if REFRACTION
  exchangeInts(e, &waiting->side, &flying->side);
#endif
  exchangeInts(e, &waiting->order, &flying->order);
  exchangeInts(e, &waiting->steps, &flying->steps);
  exchangeUints(e, &waiting->random, &flying->random);
  exchangeUints(e, &waiting->id, &flying->id);
  exchangeInts(e, &waiting->left, &flying->left);
  exchangeInts(e, &waiting->flying, &flying->flying);
  exchangeInts(e, &waiting->met, &flying->met);
}

// Flies two groups as long as every lane has a ray: whenever as many wait as a group has lanes,
// they are brought together and served.
WIDE void flyTogether(Flight* a, Flight* b, global const uint* heights, global const uint* cones,
                      constant const HeightfieldRun* run, uint seed, uint ray_count,
                      global uint* outcomes) {
  while (a->alive_count + b->alive_count == 2 * WIDTH) {
    int flying;
    do {
      fly(a, heights, cones);
      fly(b, heights, cones);
      flying = countLanes(a->flying) + countLanes(b->flying);
    } while (flying > WIDTH && (a->steps_done & 1023) != 0);
    const int together = flying <= WIDTH;
    if (together) gatherWaiting(a, b);
    serve(a, heights, cones, run, seed, ray_count, outcomes);
    // Now and then in any case, so that rays that are stuck are found.
    if (!together || (a->steps_done & 1023) == 0)
      serve(b, heights, cones, run, seed, ray_count, outcomes);
  }
}
#endif

// One work-item flies WIDTH * GROUPS * run->rays_per_lane rays, as far as there are `ray_count` in
// all. `seed`: of this launch. outcomes: for every ray the histogram word that it adds one to, then
// WIDTH unused ones.
WIDE_KERNEL void traceRays(global const uint* heights, global const uint* cones,
                           constant const HeightfieldRun* run, uint seed, uint ray_count,
                           global uint* outcomes) {
  const uint item_rays = (uint)(WIDTH * GROUPS) * run->rays_per_lane;
  Flight flights[GROUPS];
  int busy = 0;
  for (uint g = 0; g < GROUPS; ++g) {
    const uint first = (uint)get_global_id(0) * item_rays + g * (uint)WIDTH;
    flights[g] = makeFlight(run, first, ray_count);
    const vmask starting = startRays(&flights[g], run, seed, ray_count, !(vint)(0));
    takeOff(&flights[g], cones, broadcast3(run->incoming), run, starting);
    flights[g].alive_count = countLanes(flights[g].alive);
    busy |= flights[g].alive_count;
  }
#if CAN_EXCHANGE && GROUPS == 2
  flyTogether(&flights[0], &flights[1], heights, cones, run, seed, ray_count, outcomes);
  busy = flights[0].alive_count | flights[1].alive_count;
#endif
  while (busy) {
    int ready[GROUPS], stop;
    do {
      stop = 0;
      for (uint g = 0; g < GROUPS; ++g) {
        Flight* f = &flights[g];
        fly(f, heights, cones);
        const int flying = countLanes(f->flying);
        // Now and then in any case, so that rays that are stuck are found.
        ready[g] =
            (f->alive_count - flying >= SOME_WAIT) | (flying == 0) | ((f->steps_done & 1023) == 0);
        ready[g] &= f->alive_count > 0;
        stop |= ready[g];
      }
    } while (!stop);
    busy = 0;
    for (uint g = 0; g < GROUPS; ++g) {
      Flight* f = &flights[g];
      if (ready[g]) serve(f, heights, cones, run, seed, ray_count, outcomes);
      busy |= f->alive_count;
    }
  }
}
