// Layout and addressing of tables of linearly transformed cosines for anisotropic lobes, for C++
// and OpenCL C alike: macros of constants and arithmetic only, so that scalars and vectors of lanes
// both work. After [KTHDN22], with other coordinates and other numbers.
//
// Four axes of ANISO_NODES nodes each:
//   roughness   x = sqrt(alpha_u) (ANISO_NODES - 1)        the larger roughness, along u
//   ratio       x = sqrt(alpha_v / alpha_u) (ANISO_NODES - 1)
//   view        x = sqrt(ANISO_VIEW(cos theta)) (ANISO_NODES - 1)    denser towards grazing views
//   azimuth     x = |o_v| / (|o_u| + |o_v|) (ANISO_NODES - 1)    of the view o, from u to v
// A surface and its mirror images in the planes of its axes are one, so a quarter turn is enough.
//
// A cell is ANISO_FLOATS floats. They make the columns of M, not of its inverse, in the frame of
// the mirrored view (ltc_table.h), the azimuth phi being that of the view from u:
//   x   (2 alpha_u cos phi, -2 alpha_u cos theta sin phi, 0) + alpha_u (AX, AY, AZ)
//   y   (2 alpha_v sin phi,  2 alpha_v cos theta cos phi, 0) + alpha_u (BX, BY, BZ)
//   z   (0, 0, 1) + alpha_u (CX, CY, CZ)
// What stands first is what slopes along u and v move the mirrored view by, exact for narrow lobes;
// the cell holds the rest, over alpha_u. It stays finite where alpha_v vanishes: there the BRDF is
// an arc, and the lobe is as wide as the arc is bent.
#ifndef GLINTMARK_ANISOTROPIC_TABLE_H
#define GLINTMARK_ANISOTROPIC_TABLE_H

#define ANISO_NODES 8
#define ANISO_CELLS (ANISO_NODES * ANISO_NODES * ANISO_NODES * ANISO_NODES)

#define ANISO_FLOATS 12
#define ANISO_AX 0
#define ANISO_BX 3
#define ANISO_CX 6
// The BRDF's directional albedo at F0 = 1, and what Schlick's term (1 - v.h)^5 leaves of it.
#define ANISO_ALBEDO 9
#define ANISO_SCHLICK_ALBEDO 10
// The last float is 0. The device has every cell at a multiple of ANISO_STRIDE floats, so that it
// is one load.
#define ANISO_STRIDE 16

// Steps from a cell to the next along each axis, in cells.
#define ANISO_STEP_ROUGHNESS 1
#define ANISO_STEP_RATIO ANISO_NODES
#define ANISO_STEP_VIEW (ANISO_NODES * ANISO_NODES)
#define ANISO_STEP_AZIMUTH (ANISO_NODES * ANISO_NODES * ANISO_NODES)

// Of the cosine of the view angle, 0 at 1 and 1 at ANISO_LEAST_COSINE: beyond that lobes are half
// below the horizon, and their shape is a matter of luck.
#define ANISO_LEAST_COSINE 0.015f
#define ANISO_VIEW_WARP 0.15f
#define ANISO_VIEW_SCALE ((ANISO_LEAST_COSINE + ANISO_VIEW_WARP) / (1.0f - ANISO_LEAST_COSINE))
#define ANISO_VIEW(cosine) (ANISO_VIEW_SCALE * (1.0f - (cosine)) / ((cosine) + ANISO_VIEW_WARP))

// Share of the upper one of nodes n and n + 1 at n + f along an axis of roots: what is linear in
// the square is interpolated without error.
#define ANISO_SQUARE_SHARE(n, f) ((f) * (2.0f * (n) + (f)))
#define ANISO_SQUARE_WIDTH(n) (2.0f * (n) + 1.0f)

#endif
