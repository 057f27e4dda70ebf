// Ground truth by supersampling: every sample takes a point of the pixel, the finest normal there,
// and shades it like a smooth surface. [TAN05] traces 16 rays a pixel.
//
// Samples can be taken in batches; the host divides the sums by the number of all samples. The
// points of a replicate lie evenly, so they say nothing of their own error; those of another
// replicate are shifted at random, pixel by pixel (Cranley and Patterson 1976), and the spread of
// replicates does.
#include "config.clh"
#include "types.h"
#include "wide/wide.clh"

#if LTC
#include "area/area_light_truth.clh"
#endif
#if CONE_LIGHTS
#include "diffuse_layer.clh"
#include "glint/cone_light.clh"
#include "wide/wide_trig.clh"
#endif
#include "glint/hash.clh"
#include "pixel.clh"
#if NORMAL_MAP
#include "normals/normal_frame.clh"
#include "normals/texture_rgba.clh"
#endif

// Steps of the R2 sequence, 2^32 over powers of the plastic number: n points fill the square evenly
// for every n. (M. Roberts, "The Unreasonable Effectiveness of Quasirandom Sequences", 2018.)
#define STEP_X 0xC13FA9A9u
#define STEP_Y 0x91E10DA5u
// 2^32 (sqrt(2) - 1) and 2^32 (sqrt(3) - 1): steps within lights, independent of those of pixels.
#define STEP_RING 0x6A09E667u
#define STEP_TURN 0xBB67AE85u

// Cosine of a view that meets a normal at its horizon.
#define LEAST_VIEW_Z 1e-4f

// One sample of each lane's pixel.
typedef struct {
  vfloat px, py;       // screen position, pixel centres being whole numbers
  vfloat sx, sy;       // the same from the pixel's centre, [-0.5, 0.5)
  ShadingFrame frame;  // around the sample's normal, world axes
  vfloat3 view;        // unit, towards the eye, in that frame
  vmask visible;       // the normal does not turn from the eye
  vuint seed;          // random bits of the sample
  vuint ring, turn;    // two more coordinates of its point, as fractions of 2^32
} SurfaceSample;

// What a batch has in common.
typedef struct {
  vuint pixel, seed;
  ShadingFrame basis;  // the mesh's
#if NORMAL_MAP
  vuint u, v;
  vfloat dudx, dvdx, dudy, dvdy;
#endif
} PixelSurface;

WIDE PixelSurface loadSurface(global const uint* planes, size_t stride, size_t entry,
                              uint replicate) {
#define LOAD(plane) loadUint(planes, (plane)*stride + entry)
  PixelSurface s;
  s.pixel = LOAD(PLANE_PIXEL);
  s.seed = mixCell(s.pixel * HASH_U + replicate * HASH_SIZE);
  s.basis = unpackFrame(LOAD(PLANE_FRAME0), LOAD(PLANE_FRAME1));
#if NORMAL_MAP
  s.u = LOAD(PLANE_U_FRAC);
  s.v = LOAD(PLANE_V_FRAC);
  s.dudx = boundedDerivative(bitsToFloat(LOAD(PLANE_DUDX)));
  s.dvdx = boundedDerivative(bitsToFloat(LOAD(PLANE_DVDX)));
  s.dudy = boundedDerivative(bitsToFloat(LOAD(PLANE_DUDY)));
  s.dvdy = boundedDerivative(bitsToFloat(LOAD(PLANE_DVDY)));
#endif
#undef LOAD
  return s;
}

WIDE SurfaceSample sampleSurface(const PixelSurface* surface, uint index,
                                 constant const FrameParams* frame
#if NORMAL_MAP
                                 ,
                                 constant const MipTexture* map, global const float4* normals
#endif
) {
  SurfaceSample s;
  const vuint x = surface->seed + index * STEP_X;
  const vuint y = mixCell(surface->seed + HASH_V) + index * STEP_Y;
  s.sx = toFloat(bitsToInt(x)) * 0x1p-32f;
  s.sy = toFloat(bitsToInt(y)) * 0x1p-32f;
  s.px = toFloat(surface->pixel & 0xFFFFu) + s.sx;
  s.py = toFloat(surface->pixel >> 16) + s.sy;
  s.seed = mixCell(surface->seed + index * HASH_MIX_3);
  s.ring = mixCell(surface->seed + HASH_MIX_3) + index * STEP_RING;
  s.turn = mixCell(surface->seed + HASH_MIX_3 + HASH_V) + index * STEP_TURN;
#if NORMAL_MAP
  const vuint u = surface->u + uvFraction(fma(surface->dudx, s.sx, surface->dudy * s.sy));
  const vuint v = surface->v + uvFraction(fma(surface->dvdx, s.sx, surface->dvdy * s.sy));
  const ProbeGrid probe = singleProbe(map, u, v, (vfloat)(0.0f));
  vfloat4 mean;
  fetchTexels1(map, normals, &probe, TEXTURE_REPEAT, &mean);
  const vfloat3 bent = {mean.x, mean.y, mean.z};
  s.frame = turnFrame(surface->basis, scale3(bent, wideRsqrt(dot3(bent, bent))));
#else
  s.frame = surface->basis;
#endif
  const vfloat3 ray = pixelRay(s.px, s.py, frame);
  s.view = toLocal(s.frame, scale3(ray, -wideRsqrt(dot3(ray, ray))));
  s.visible = s.view.z > 0.0f;
  // From behind the normal the eye is moved to its horizon, at full length: directions are mirrored
  // at the view to sample diffuse light too.
  const vmask low = s.view.z < LEAST_VIEW_Z;
  const vfloat flat_sq = max(fma(s.view.x, s.view.x, s.view.y * s.view.y), (vfloat)(1e-12f));
  const vfloat stretch = low ? wideRsqrt(flat_sq) : (vfloat)(1.0f);
  s.view.x *= stretch;
  s.view.y *= stretch;
  s.view.z = max(s.view.z, (vfloat)(LEAST_VIEW_Z));
  return s;
}

#if CONE_LIGHTS
// The direction of a sample of number `which` of a cone light, world axes. Solid angles are even in
// 1 - cos and in the turn around the axis; every light has its own shift of the sample's point.
WIDE vfloat3 sampleCone(const SurfaceSample* sample, constant const LightParams* light,
                        uint which) {
  const vfloat ring = toFloat((sample->ring + which * HASH_U) >> 8) * 0x1p-24f;
  const vfloat turn = toFloat((sample->turn + which * HASH_V) >> 8) * 0x1p-24f;
  const vfloat height = ring * light->one_minus_cos;
  const vfloat radius = wideRoot(height * (2.0f - height));
  const SineCosine around = sineCosineTurns(turn);
  // Orthonormal basis of the axis: Duff et al. 2017, Listing 3.
  const float4 n = light->direction;
  const float sign = n.z < 0.0f ? -1.0f : 1.0f, a = -1.0f / (sign + n.z), b = n.x * n.y * a;
  const vfloat x = radius * around.cosine, y = radius * around.sine, z = 1.0f - height;
  const vfloat3 d = {fma(x, 1.0f + sign * n.x * n.x * a, fma(y, b, z * n.x)),
                     fma(x, sign * b, fma(y, sign + n.y * n.y * a, z * n.y)),
                     fma(x, -sign * n.x, fma(y, -n.y, z * n.z))};
  return d;
}

WIDE vfloat3 shadeSample(const SurfaceSample* sample, constant const FrameParams* frame,
                         constant const MaterialParams* material,
                         constant const LightParams* lights) {
  const vfloat3 ratio = {(vfloat)(1.0f), (vfloat)(1.0f), (vfloat)(1.0f)};
  vfloat3 share = {(vfloat)(1.0f), (vfloat)(1.0f), (vfloat)(1.0f)};
#if ALBEDO_SCALING
  share =
      diffuseShare(lobeAlbedo(sample->view.z, &material->surface), noGain(), &material->surface);
#endif
  const SurfaceAlpha alpha = surfaceAlpha(material->surface.alpha_g);
  const SmithLambda lambda_view = smithLambda(sample->view, alpha);
  vfloat3 sum = {(vfloat)(0.0f), (vfloat)(0.0f), (vfloat)(0.0f)};
  for (uint i = 0; i < frame->light_count; ++i) {
    const vfloat3 light = toLocal(sample->frame, sampleCone(sample, &lights[i], i));
    LightLobe lobe = pointLobe(light, sample->view, lambda_view, alpha, material);
#if NORMAL_MAP
    lobe.specular = sample->visible ? lobe.specular : (vfloat)(0.0f);
    lobe.schlick = sample->visible ? lobe.schlick : (vfloat)(0.0f);
#endif
    addLight(lobe, ratio, share, &material->surface, &lights[i], &sum);
  }
  return sum;
}
#endif

#if LTC
// Where a sample lies, relative to the eye: its ray meets the tangent plane of the pixel's centre,
// at most twice as near or as far as the centre lies.
WIDE vfloat3 samplePlace(const PixelSurface* surface, const SurfaceSample* sample, vfloat depth,
                         constant const FrameParams* frame) {
  const vfloat3 centre =
      pixelRay(toFloat(surface->pixel & 0xFFFFu), toFloat(surface->pixel >> 16), frame);
  const vfloat3 ray = pixelRay(sample->px, sample->py, frame);
  const vfloat along = dot3(ray, surface->basis.normal);
  const vfloat ratio = along != 0.0f ? dot3(centre, surface->basis.normal) / along : (vfloat)(1.0f);
  return scale3(ray, depth * clamp(ratio, (vfloat)(0.5f), (vfloat)(2.0f)));
}
#endif

WIDE void addToPlane(vfloat value, global float* sums, size_t i) {
  storeFloat(bitsToFloat(loadUint((global const uint*)sums, i)) + value, sums, i);
}

// Adds `sample_count` samples of a replicate, from number `sample_begin` on, to `sums`: three
// planes of frame->plane_stride entries, radiance (r, g, b). Lights are sampled over their cones.
WIDE_KERNEL void truth(global const uint* planes, constant const FrameParams* frame,
                       constant const MaterialParams* material, constant const LightParams* lights,
#if NORMAL_MAP
                       constant const MipTexture* map, global const float4* map_texels,
#endif
#if LTC
                       constant const AreaLightParams* area_lights, global const float* ltc_table,
#if LIGHT_TEXTURE
                       constant const MipTexture* pictures, global const float4* picture_texels,
#endif
#endif
                       global float* sums, uint replicate, uint sample_begin, uint sample_count) {
  const size_t first = get_global_id(0) * WIDTH;
  if (first >= frame->list_count) return;
  const size_t entry = frame->list_offset + first, stride = frame->plane_stride;
  const PixelSurface surface = loadSurface(planes, stride, entry, replicate);
  vfloat3 sum = {(vfloat)(0.0f), (vfloat)(0.0f), (vfloat)(0.0f)};
#if LTC
  const vfloat depth = bitsToFloat(loadUint(planes, PLANE_DEPTH * stride + entry));
#endif
  for (uint i = 0; i < sample_count; ++i) {
    const SurfaceSample sample = sampleSurface(&surface, sample_begin + i, frame
#if NORMAL_MAP
                                               ,
                                               map, map_texels
#endif
    );
    vfloat3 value = {(vfloat)(0.0f), (vfloat)(0.0f), (vfloat)(0.0f)};
#if CONE_LIGHTS
    value = shadeSample(&sample, frame, material, lights);
#endif
#if LTC
    const vfloat3 place = samplePlace(&surface, &sample, depth, frame);
    value = add3(value, sampleAreaLights(sample.frame, place, sample.view, sample.visible,
                                         &material->surface, sample.seed, area_lights,
                                         frame->area_light_count PICTURE_ARGUMENTS));
#endif
    sum.x += value.x;
    sum.y += value.y;
    sum.z += value.z;
  }
  addToPlane(sum.x, sums, entry);
  addToPlane(sum.y, sums, stride + entry);
  addToPlane(sum.z, sums, 2 * stride + entry);
}
