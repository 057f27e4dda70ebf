// Constants of the meso scale, method `exact`, for C++ and OpenCL C alike: roughness of the normals
// under a pixel from the length of their mean, and roughness of both scales together.
// `glintmark fit meso` derives and prints them (host/fit/meso_fit.cpp); a test does so again.
// [TAO21] Tao et al., "Real-Time Antialiased Area Lighting Using Multi-Scale Linearly Transformed
// Cosines", EG 2021 short papers.
#ifndef GLINTMARK_MESO_TABLE_H
#define GLINTMARK_MESO_TABLE_H

// Inverse of [TAO21] Eq. 4. With t = sqrt(1 - |b|) and x = sqrt(t),
//   alpha_me = t P(x),   P(x) = INVERSE_0 + INVERSE_1 x + ... + INVERSE_8 x^8,
// clamped to [0, 1]. Relative error below 0.0006 for alpha_me from 0.001 to 1; a length
// at or below 2/3 is alpha_me = 1, one at or above 1 is 0.
#define MESO_INVERSE_0 0.316950735f
#define MESO_INVERSE_1 1.70762792f
#define MESO_INVERSE_2 -6.63119242f
#define MESO_INVERSE_3 25.0944567f
#define MESO_INVERSE_4 -45.8199556f
#define MESO_INVERSE_5 21.7312072f
#define MESO_INVERSE_6 73.1000037f
#define MESO_INVERSE_7 -126.898362f
#define MESO_INVERSE_8 64.7530351f
#define MESO_LENGTH_MIN 0.66666667f

// Roughness of the spherical convolution, [TAO21] Eq. 6. With M and m the larger and the smaller
// of alpha_mi and alpha_me,
//   alpha = min(1, M + m^2 JOIN_A (1 - M (JOIN_C M + JOIN_D m)) / (M + JOIN_B m)),
// which is M where m = 0 (and 0 where M = 0: guard the division). Against the closest scaled cosine
// over a grid of 32 x 32 roughnesses its squared errors sum to 0.0019 and the largest is 0.0043;
// those of [TAO21] Eq. 7 sum to 0.16 and the largest is 0.036.
#define MESO_JOIN_A 4.09560638f
#define MESO_JOIN_B 4.86443699f
#define MESO_JOIN_C 0.561797437f
#define MESO_JOIN_D 0.124212558f

#endif
