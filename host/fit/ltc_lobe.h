// A linearly transformed cosine of an isotropic BRDF in parameters that mean something, for fits.
//
// M = R S: the cosine lobe is scaled and sheared in the plane of view and normal, then turned by R
// about y. Four numbers, as many as the five entries of M^-1 have up to a factor, chosen such that
// for narrow lobes each does one thing: the widths and the direction decide nearly everything, and
// the shear is left with what little else there is.
#pragma once
#include <glm/glm.hpp>

#include "host/fit/ltc_table.h"

namespace glintmark {

struct LtcLobe {
  double log_width_x = 0;  // angular width in the plane of view and normal
  double log_width_y = 0;  // and across it
  double shear = 0;        // S z = (shear, 0, 1)
  double tilt_rad = 0;     // M z is along (sin tilt, 0, cos tilt); < 0 turns away from the view
};

/// The same lobe as the product of its factors.
struct LtcFactors {
  double width_x = 1, width_y = 1;  // S x = (width_x, 0, 0), S y = (0, width_y, 0)
  double shear = 0;
  double cos_turn = 1, sin_turn = 0;  // R z = (sin, 0, cos)
};
LtcFactors factorsOf(const LtcLobe& lobe);

/// M^-1 of a lobe, scaled such that its middle entry is 1.
glm::dmat3 ltcInverseMatrix(const LtcLobe& lobe);

/// The same as stored in a table at roughness alpha > 0 and view angle theta: entries XX to ZZ of
/// `cell`, see kernels/area/ltc_table.h.
void storeLobe(const LtcLobe& lobe, double alpha, double cos_theta, LtcCell& cell);

/// M^-1 of a cell at roughness alpha > 0 and view angle theta, middle entry 1, for directions in
/// the frame of the normal.
glm::dmat3 ltcInverseMatrix(const LtcCell& cell, double alpha, double cos_theta);

/// The lobe of a matrix with the entries of ltcInverseMatrix, at any scale.
LtcLobe lobeOfMatrix(const glm::dmat3& inverse);

/// What the lobe tends to as alpha -> 0: the slopes of half vectors, mirrored about the view.
LtcLobe mirrorLobe(double alpha, double cos_theta);

}  // namespace glintmark
