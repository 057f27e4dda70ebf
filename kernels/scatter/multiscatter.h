// What the kernels need of a material whose microfacets scatter light more than once, and of lights
// for it, once for host and kernels. Rules as in types.h. Polynomials are in a cosine, lowest power
// first.
#ifndef GLINTMARK_MULTISCATTER_H
#define GLINTMARK_MULTISCATTER_H

#define MS_DEGREES 8  // coefficients per polynomial

// What a rough mirror reflects by one bounce falls and rises again within cosines of the size of
// its roughness. It is a polynomial of t = mu (1 + s) / (mu + s) with s = MS_WARP alpha.
#define MS_WARP 2.0f

typedef struct MultiscatterMaterial {
  float4 single;                   // rgb: colour of single scattering over pi; w unused
  float4 multiple;                 // rgb: of the higher orders, with their normalisation; w unused
  float share[MS_DEGREES];         // lobes: energy that single scattering keeps, of the cosine of
                                   // incidence; EON, fitted: what their single scattering loses
  float crowd[MS_DEGREES];         // lobes: radiance that the higher orders send out of a white
                                   // furnace at albedo 1, over mu^(eta - 1) and over what there is
                                   // for them, of the view's cosine
  float masked_crowd[MS_DEGREES];  // the same, masked on the way in
  float4 scale;       // lobes: sigma of the cosine of incidence; fitted: the first four
                      // coefficients of single scattering
  float4 flattening;  // lobes: sigma_n of it; fitted: the other two
  float compensation[MS_DEGREES];  // metals, of a cosine warped by MS_WARP: what one bounce off a
                                   // mirror loses, 1 - E; scaled lobes: 1 / E - 1
  float schlick[MS_DEGREES];  // fdez_aguera: of the energy E, the mean of (1 - cosine)^5 on facets,
                              // of the view's cosine
  float4 bounced;  // metals, rgb. Scaled: how much of 1 / E - 1 the lobe gets; kulla_conty: what
                   // (1 - E) (1 - E) is multiplied by; fdez_aguera: mean Fresnel reflectance
  float exponent;  // lobes: eta - 1; EON: its roughness; fitted: what its single
                   // scattering loses with the sine of incidence
  float alpha;     // lobes: roughness of the masking factor
  float masking;   // lobes: importance of the masking factor, [0, 1]
  float warp;      // metals: MS_WARP times the roughness
} MultiscatterMaterial;

// Which of the taps are a cone light's: directions of equal solid angles within its cone, as float4
// (xyz: unit vector). What is smooth over a light sums over them.
typedef struct LightTaps {
  uint first;
  uint count;  // >= 1
} LightTaps;

#endif
