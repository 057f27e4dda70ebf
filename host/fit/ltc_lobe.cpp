#include "host/fit/ltc_lobe.h"

#include <algorithm>
#include <cmath>

namespace glintmark {

LtcFactors factorsOf(const LtcLobe& lobe) {
  // S stretches what lies along S z by |S z|, and the plane of view and normal is seen at a slant.
  const double stretch_sq = 1 + lobe.shear * lobe.shear;
  const double turn = lobe.tilt_rad - std::atan(lobe.shear);
  return {.width_x = std::exp(lobe.log_width_x) * stretch_sq,
          .width_y = std::exp(lobe.log_width_y) * std::sqrt(stretch_sq),
          .shear = lobe.shear,
          .cos_turn = std::cos(turn),
          .sin_turn = std::sin(turn)};
}

// glm matrices are indexed [column][row].
glm::dmat3 ltcInverseMatrix(const LtcLobe& lobe) {
  const LtcFactors f = factorsOf(lobe);
  const double ratio = f.width_y / f.width_x, shear = f.shear * ratio;
  glm::dmat3 inverse(1.0);
  inverse[0][0] = ratio * f.cos_turn - shear * f.sin_turn;
  inverse[2][0] = -ratio * f.sin_turn - shear * f.cos_turn;
  inverse[0][2] = f.width_y * f.sin_turn;
  inverse[2][2] = f.width_y * f.cos_turn;
  return inverse;
}

void storeLobe(const LtcLobe& lobe, double alpha, double cos_theta, LtcCell& cell) {
  LtcLobe about_mirror = lobe;
  about_mirror.tilt_rad += std::acos(std::clamp(cos_theta, 0.0, 1.0));
  const glm::dmat3 inverse = ltcInverseMatrix(about_mirror);
  cell.xx = inverse[0][0];
  cell.xz = inverse[2][0];
  cell.zx = inverse[0][2] / alpha;
  cell.zz = inverse[2][2] / alpha;
}

glm::dmat3 ltcInverseMatrix(const LtcCell& cell, double alpha, double cos_theta) {
  const double c = std::clamp(cos_theta, 0.0, 1.0), s = std::sqrt((1 - c) * (1 + c));
  glm::dmat3 inverse(1.0);
  inverse[0][0] = LTC_TURNED_X(cell.xx, cell.xz, s, c);
  inverse[2][0] = LTC_TURNED_Z(cell.xx, cell.xz, s, c);
  inverse[0][2] = LTC_TURNED_X(cell.zx, cell.zz, s, c) * alpha;
  inverse[2][2] = LTC_TURNED_Z(cell.zx, cell.zz, s, c) * alpha;
  return inverse;
}

LtcLobe lobeOfMatrix(const glm::dmat3& inverse) {
  const glm::dmat3 m = inverse / inverse[1][1];
  const double width_y = std::hypot(m[0][2], m[2][2]);
  const double s = m[0][2] / width_y, c = m[2][2] / width_y;
  const double ratio = m[0][0] * c - m[2][0] * s;
  const double shear = -(m[0][0] * s + m[2][0] * c) / ratio;
  const double stretch_sq = 1 + shear * shear;
  return {.log_width_x = std::log(width_y / (ratio * stretch_sq)),
          .log_width_y = std::log(width_y / std::sqrt(stretch_sq)),
          .shear = shear,
          .tilt_rad = std::atan2(s, c) + std::atan(shear)};
}

LtcLobe mirrorLobe(double alpha, double cos_theta) {
  // A half vector's slope h moves the reflected direction by 2 h in the plane of view and normal
  // and by 2 h cos(theta) across it. At grazing angles alpha takes the place of the cosine.
  const double across = std::clamp(std::hypot(cos_theta, alpha), 0.0, 1.0);
  return {.log_width_x = std::log(2 * alpha),
          .log_width_y = std::log(2 * alpha * across),
          .shear = 0,
          .tilt_rad = -std::acos(std::clamp(cos_theta, 0.0, 1.0))};
}

}  // namespace glintmark
