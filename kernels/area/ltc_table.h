// Layout and addressing of the tables of linearly transformed cosines, for C++ and OpenCL C alike:
// macros of constants and arithmetic only, so that scalars and vectors of lanes both work.
//
// A table is LTC_SIZE_DEFAULT (or any other size) rows of cells, row-major: x runs over roughness,
// y over the view angle, both addressed linearly and with their first and last nodes on 0 and 1:
//   x = sqrt(alpha) (size - 1)            alpha: GGX or Beckmann roughness
//   y = sqrt(1 - cos theta) (size - 1)    theta: angle between the view and the normal
// and every cell is LTC_CELL_FLOATS floats.
//
// The inverse matrix is stored for the frame of the mirrored view: with the view at
// (sin theta, 0, cos theta) and the normal along z, that frame is turned about y such that its z
// lies along (-sin theta, 0, cos theta). In it
//              | XX        0  XZ       |
//   M_m^-1  =  | 0         1  0        |
//              | alpha ZX  0  alpha ZZ |
// and for directions in the frame of the normal M^-1 = M_m^-1 Q:
//            | cos theta   0  sin theta |
//   Q     =  | 0           1  0         |
//            | -sin theta  0  cos theta |
//
// Why so: a factor common to all entries cancels in [HDHN16] Eq. 1, so the middle entry is made 1.
// What remains stays finite and smooth where alpha -> 0: XX is the ratio of the lobe's widths, and
// the last row, which vanishes with alpha, is stored divided by it. The reader multiplies by its
// own alpha and turns by its own theta, both exact, so narrow lobes stay as narrow and where they
// belong between nodes. Interpolating M^-1 as such would move them by many times their width.
#ifndef GLINTMARK_LTC_TABLE_H
#define GLINTMARK_LTC_TABLE_H

#define LTC_SIZE_MIN 8
#define LTC_SIZE_DEFAULT 64  // 16 would do for frames (docs/accuracy.md), not for narrow lobes
#define LTC_SIZE_MAX 128

// Smallest roughness that readers may pass on: below it single precision loses the last row.
#define LTC_ALPHA_MIN 1e-6f

#define LTC_CELL_FLOATS 8
#define LTC_XX 0
#define LTC_XZ 1
#define LTC_ZX 2
#define LTC_ZZ 3
// Factors of the integral over a light that was clipped to the normal's hemisphere: the reflected
// radiance is (F0 SCALE + (1 - F0) SCHLICK) times it. A light that fills the hemisphere reflects
// exactly what the BRDF reflects; what the lobe has below the horizon is made up for.
#define LTC_SCALE 4
#define LTC_SCHLICK 5
// The BRDF's own directional albedo at F0 = 1, and what Schlick's term (1 - v.h)^5 leaves of it.
#define LTC_ALBEDO 6
#define LTC_SCHLICK_ALBEDO 7

// Continuous coordinate of a cell along x or y. `root` is sqrt(alpha) or sqrt(1 - cos theta),
// clamped to [0, 1] by the caller; `size` is the table's, as a float.
#define LTC_COORDINATE(root, size) ((root) * ((size)-1.0f))

// Columns x and z of row (X, Z) of M_m^-1 Q, from the stored row and the view's sine and cosine.
#define LTC_TURNED_X(x, z, sine, cosine) ((x) * (cosine) - (z) * (sine))
#define LTC_TURNED_Z(x, z, sine, cosine) ((x) * (sine) + (z) * (cosine))

// First float of the cell in column x (roughness) and row y (view angle), 0 <= x, y < size.
#define LTC_CELL(x, y, size) (((y) * (size) + (x)) * LTC_CELL_FLOATS)

#endif
