// What the grids of a material have in common over all pixels. The host of any renderer computes it
// once, in double precision, so that no device's division or root decides where cells lie.
//
// C, C++ and OpenCL C. A C or C++ host includes <math.h> and types.h (with its own float2, float4
// and uint) before this file.
#ifndef GLINTMARK_GLINT_GRIDS_H
#define GLINTMARK_GLINT_GRIDS_H

// Finest and coarsest usable level: cell indices stay within 32 bits for |uv| < 2.
#define GM_MIN_LEVEL (-30)
#define GM_MAX_LEVEL 30

// Compression is a multiple of this fraction, so that stretched coordinates are exact in integers.
#define GM_GAMMA_BITS 12
#define GM_GAMMA_UNIT 4096.0f

#ifndef __OPENCL_VERSION__

// Compression of one axis: meso roughness over that of the other axis, both squared. Beyond
// 1024 : 1 a cell is longer than the screen. [ZK16] Sect. 4.4
static inline float glintGamma(double meso_sq, double other_meso_sq) {
  const double unit = GM_GAMMA_UNIT;
  const double steps = floor(sqrt(meso_sq / other_meso_sq) * unit + 0.5);
  return (float)((steps < 4.0 ? 4.0 : steps > unit ? unit : steps) / unit);
}

// Sets gamma and finest_level from the other members and the surface's roughness. Grooves, which
// run along u, are the longer the nearer their roughness along u is to the surface's.
static inline void setGlintGrids(GlintMaterial* glints, float2 alpha_g) {
  const double alpha_lu = glints->alpha_l.x, alpha_lv = glints->alpha_l.y;
  const double u = (double)alpha_g.x * alpha_g.x - alpha_lu * alpha_lu;
  const double v = (double)alpha_g.y * alpha_g.y - alpha_lv * alpha_lv;
  const double meso_u = u < 1e-12 ? 1e-12 : u, meso_v = v < 1e-12 ? 1e-12 : v;
  double count = glints->density;
  int level = 0;
  glints->gamma.x = glintGamma(meso_u, meso_v);
  glints->gamma.y = glintGamma(meso_v, meso_u);

  // The finest cells hold one microdetail at least: one that is wider than a pixel spans pixels.
  // [ZK16] Sect. 3
  count /= (double)glints->gamma.x * glints->gamma.y;
  for (; level > GM_MIN_LEVEL && count >= 4.0; --level) count *= 0.25;
  for (; level < GM_MAX_LEVEL - 1 && count < 1.0; ++level) count *= 4.0;
  glints->finest_level = level;
}

#endif

#endif
