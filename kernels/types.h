// Structs shared by the host (C++20) and the device (OpenCL C 1.2), and nothing else.
//
// Rules: four-byte scalars, float2 and float4 only; no bool, enum, size_t, pointer, float3 or
// double. The host defines float2 and float4 in host/core/shared_types.h, which also asserts the
// sizes below; probe.cl reports the device's sizes and a test compares the two.
#ifndef GLINTMARK_TYPES_H
#define GLINTMARK_TYPES_H

#define GM_MAX_PALETTE 8u

// A pixel list is padded with copies of its last pixel to a multiple of this, so that a kernel of
// any lane count never reads past the end and needs no tail code.
#define GM_LIST_PADDING 64u

// Coefficients of a polynomial of the view's cosine, lowest power first.
#define GM_ALBEDO_DEGREES 8

// What every material has: its smooth lobe and what lies under it.
typedef struct SurfaceMaterial {
  float2 alpha_g;   // global roughness along u and v, (0, 1]
  float intensity;  // overall scale of the specular lobe, >= 0
  uint effects;     // EFFECT_* bits of config.clh; read by ALL_MATERIALS programs only
  float4 f0;        // rgb reflectance at normal incidence; w unused
  float4 albedo;    // rgb diffuse albedo; w unused
  // Of ALBEDO_SCALING programs: what the lobe reflects at f0 = 1, by the cosine t warped so that it
  // falls within cosines of the size of the roughness, t = mu (1 + s) / (mu + s) with s =
  // albedo_warp; and the share of that which Schlick's (1 - o.h)^5 leaves, by mu.
  float mirror_albedo[GM_ALBEDO_DEGREES];
  float schlick_share[GM_ALBEDO_DEGREES];
  float albedo_warp;
  float reserved[3];  // 0
} SurfaceMaterial;

// Microdetails of one material, in the paper's user parameters made absolute. [ZK16] Sect. 4.5
typedef struct GlintMaterial {
  float2 alpha_l;                  // Beckmann roughness of one microdetail, absolute, (0, alpha_g]
  float density;                   // microdetails per unit uv area, > 0
  float size_variation;            // standard deviation of the microdetail count factor, >= 0
  float4 palette[GM_MAX_PALETTE];  // rgb albedo of a microdetail; w unused
  uint palette_count;              // colours in palette; 0 = uniform colour wheel
  int finest_level;  // of grids, see footprint.clh; with gamma, by setGlintGrids of glint_grids.h
  float2 gamma;      // compression of the grids along u and v, (0, 1] [ZK16] Sect. 4.4
} GlintMaterial;

// One material as a launch reads it.
typedef struct MaterialParams {
  SurfaceMaterial surface;
  GlintMaterial glints;
} MaterialParams;

// A light at infinity that fills a cone of directions evenly. [ZK16] Sect. 4.3, Fig. 8
typedef struct ConeLight {
  float4 direction;   // xyz: unit vector towards the light, world space; w: cone half-angle [rad]
  float4 irradiance;  // rgb on a surface that faces the light's axis; w unused
} ConeLight;

// A ConeLight made ready for the kernels by host/frame.
typedef struct LightParams {
  float4 direction;     // xyz: unit vector towards the light's axis; w: slope radius of its half
                        // vectors near the normal, half the cone's half-angle [rad]
  float4 power;         // rgb: radiance times solid angle; w unused
  float one_minus_cos;  // of the half-angle, 0 for a point
  float cotangent;      // of the half-angle, 0 at 90 degrees and for a point
  uint skip;            // entries to the next light that is no part of this one; 1: it has no parts
  float reach;          // chord from the axis that all directions of its parts are within
} LightParams;

// What one shading launch needs beside its pixels.
typedef struct FrameParams {
  float4 ray_origin;  // xyz: world-space direction through pixel centre (0, 0), not normalised
  float4 ray_dx;      // xyz: what one pixel to the right adds to it
  float4 ray_dy;      // xyz: what one pixel down adds to it
  uint light_count;
  uint list_offset;   // first entry of this launch's pixel list
  uint list_count;    // entries to shade, padding not counted
  uint plane_stride;  // entries between two planes
  uint area_light_count;
  uint ltc_size;     // nodes per side of the table of linearly transformed cosines
  uint reserved[2];  // 0
} FrameParams;

#define GM_MAX_LIGHT_VERTICES 8u

// A light that emits the same radiance in all directions, made ready for the kernels by host/frame:
// a flat convex polygon, or a shape with a round side.
//
// A disc has its centre in vertices[0]; a tube, which is closed by a disc at either end, has its
// ends in vertices[0] and [1]. Vertices 2 and 3 of both are two radii at right angles to each other
// and to the disc's normal or the tube's axis, as vectors. A sphere has its centre and that alone.
typedef struct AreaLightParams {
  float4
      vertices[GM_MAX_LIGHT_VERTICES];  // xyz: world axes, relative to the eye, counter-clockwise
                                        // from the front; the last is repeated; w unused
  float4 plane;     // xyz: unit normal of the front; w: its component along that normal. Of a tube:
                    // unit axis from its first end to the other, and its length
  float4 radiance;  // rgb; w: radius of a disc, sphere or tube
  float back;       // -1: the back (of a sphere or tube: the inside) emits as well, 0: it is black
  uint shape;       // 3 to GM_MAX_LIGHT_VERTICES: vertices of a polygon; or LIGHT_DISC and so on
  float area;       // scene units squared
  uint texture;     // index of its texture, where it has one; else NO_LIGHT_TEXTURE
} AreaLightParams;
#define NO_LIGHT_TEXTURE 0xFFFFFFFFu
#define LIGHT_DISC 0u
#define LIGHT_SPHERE 1u
#define LIGHT_TUBE 2u
#define LEAST_LIGHT_VERTICES 3u

// Levels of the largest texture, 32768 texels wide.
#define GM_MAX_MIP_LEVELS 16u

// A mip chain in one buffer of float4, row after row and level after level. Level l has
// max(1, width >> l) x max(1, height >> l) texels; row 0 is at v = 0. A texel is 1 to 8
// float4.
typedef struct MipTexture {
  uint width;   // texels of level 0, 1 to 32768
  uint height;  // the same
  uint level_count;
  uint reserved;                  // 0
  uint first[GM_MAX_MIP_LEVELS];  // first texel of each level, counted in texels
} MipTexture;

#endif
