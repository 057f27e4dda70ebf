#include "host/fit/ltc_table.h"

#include <algorithm>
#include <cmath>

namespace glintmark {
namespace {

// Weights of one axis: two neighbouring nodes.
struct Nodes {
  int first = 0;
  double fraction = 0;
};

Nodes nodesAt(double root, int size) {
  const double x = LTC_COORDINATE(std::clamp(root, 0.0, 1.0), size);
  const int first = std::min(static_cast<int>(x), size - 2);
  return {first, x - first};
}

LtcCell mix(const LtcCell& a, const LtcCell& b, double t) {
  const auto lerp = [t](double from, double to) { return std::lerp(from, to, t); };
  return {.xx = lerp(a.xx, b.xx),
          .xz = lerp(a.xz, b.xz),
          .zx = lerp(a.zx, b.zx),
          .zz = lerp(a.zz, b.zz),
          .scale = lerp(a.scale, b.scale),
          .schlick = lerp(a.schlick, b.schlick),
          .albedo = lerp(a.albedo, b.albedo),
          .schlick_albedo = lerp(a.schlick_albedo, b.schlick_albedo)};
}

}  // namespace

LtcCell LtcTable::cell(int x, int y) const {
  const float* f = values.data() + LTC_CELL(static_cast<std::size_t>(x), y, size);
  return {.xx = f[LTC_XX],
          .xz = f[LTC_XZ],
          .zx = f[LTC_ZX],
          .zz = f[LTC_ZZ],
          .scale = f[LTC_SCALE],
          .schlick = f[LTC_SCHLICK],
          .albedo = f[LTC_ALBEDO],
          .schlick_albedo = f[LTC_SCHLICK_ALBEDO]};
}

void LtcTable::setCell(int x, int y, const LtcCell& cell) {
  float* f = values.data() + LTC_CELL(static_cast<std::size_t>(x), y, size);
  f[LTC_XX] = static_cast<float>(cell.xx);
  f[LTC_XZ] = static_cast<float>(cell.xz);
  f[LTC_ZX] = static_cast<float>(cell.zx);
  f[LTC_ZZ] = static_cast<float>(cell.zz);
  f[LTC_SCALE] = static_cast<float>(cell.scale);
  f[LTC_SCHLICK] = static_cast<float>(cell.schlick);
  f[LTC_ALBEDO] = static_cast<float>(cell.albedo);
  f[LTC_SCHLICK_ALBEDO] = static_cast<float>(cell.schlick_albedo);
}

double ltcColumnAlpha(int x, int size) {
  const double root = static_cast<double>(x) / (size - 1);
  return root * root;
}

double ltcRowCosine(int y, int size) {
  const double root = static_cast<double>(y) / (size - 1);
  return 1 - root * root;
}

LtcCell lookUpLtc(const LtcTable& table, double alpha, double cos_theta) {
  const Nodes x = nodesAt(std::sqrt(std::max(alpha, 0.0)), table.size);
  const Nodes y = nodesAt(std::sqrt(std::max(1 - cos_theta, 0.0)), table.size);
  const auto row = [&](int at) {
    return mix(table.cell(x.first, at), table.cell(x.first + 1, at), x.fraction);
  };
  return mix(row(y.first), row(y.first + 1), y.fraction);
}

LtcTable resizedLtcTable(const LtcTable& table, int size) {
  LtcTable resized(table.ndf, size);
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      resized.setCell(x, y, lookUpLtc(table, ltcColumnAlpha(x, size), ltcRowCosine(y, size)));
  return resized;
}

}  // namespace glintmark
