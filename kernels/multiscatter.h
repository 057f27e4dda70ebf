// What the kernels need of a material whose microfacets scatter light more than once, once for host
// and kernels. Rules as in types.h. Polynomials are in a cosine, lowest power first.
#ifndef GLINTMARK_MULTISCATTER_H
#define GLINTMARK_MULTISCATTER_H

#define MS_DEGREES 8  // coefficients per polynomial

typedef struct MultiscatterMaterial {
  float4 single;                   // rgb: colour of single scattering over pi; w unused
  float4 multiple;                 // rgb: of the higher orders, with their normalisation; w unused
  float share[MS_DEGREES];         // lobes: energy that single scattering keeps, of the cosine of
                                   // incidence; EON: what its single scattering loses
  float4 scale;                    // lobes: sigma of the cosine of incidence
  float4 flattening;               // lobes: sigma_n of it
  float compensation[MS_DEGREES];  // metals: 1 / energy of one bounce - 1, of the view's cosine
  float exponent;                  // lobes: eta - 1; EON: its roughness
  float padding[3];
} MultiscatterMaterial;

#endif
