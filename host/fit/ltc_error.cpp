#include "host/fit/ltc_error.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "host/fit/ltc_fit.h"
#include "host/fit/ltc_samples.h"
#include "host/reference/ltc.h"

namespace glintmark {
namespace {

constexpr LtcSampleCounts kErrorSamples = {
    .lobe_radial = 96, .lobe_azimuth = 40, .hemisphere_radial = 64, .hemisphere_azimuth = 32};

}  // namespace

double ltcCellError(reference::Ndf ndf, const LtcCell& cell, double alpha, double cos_theta) {
  const glm::dmat3 inverse = ltcInverseMatrix(cell, alpha, cos_theta);
  const LtcSamples samples =
      makeLtcSamples(ndf, alpha, cos_theta, lobeOfMatrix(inverse), kErrorSamples);
  double error = 0;
  for (std::size_t i = 0; i < samples.x.size(); ++i) {
    const glm::dvec3 direction(samples.x[i], std::sqrt(samples.y_sq[i]), samples.z[i]);
    error += samples.weight[i] *
             std::abs(cell.scale * reference::ltcDensity(inverse, direction) - samples.brdf[i]);
  }
  return error;
}

double LtcErrors::mean() const {
  return std::reduce(values.begin(), values.end()) / static_cast<double>(values.size());
}

double LtcErrors::max() const {
  return *std::max_element(values.begin(), values.end());
}

LtcErrors ltcNodeErrors(const LtcTable& table) {
  LtcErrors errors{table.size, table.size, {}};
  errors.values.resize(static_cast<std::size_t>(table.size) * table.size);
  tbb::parallel_for(0, table.size, [&](int y) {
    for (int x = 0; x < table.size; ++x) {
      errors.values[static_cast<std::size_t>(y) * table.size + x] = ltcCellError(
          table.ndf, table.cell(x, y), ltcFitAlpha(x, table.size), ltcRowCosine(y, table.size));
    }
  });
  return errors;
}

LtcErrors ltcMidpointErrors(const LtcTable& table) {
  const int count = table.size - 1;
  LtcErrors errors{count, count, {}};
  errors.values.resize(static_cast<std::size_t>(count) * count);
  tbb::parallel_for(0, count, [&](int y) {
    const double root_y = (y + 0.5) / count, cosine = 1 - root_y * root_y;
    for (int x = 0; x < count; ++x) {
      const double root_x = (x + 0.5) / count, alpha = root_x * root_x;
      errors.values[static_cast<std::size_t>(y) * count + x] =
          ltcCellError(table.ndf, lookUpLtc(table, alpha, cosine), alpha, cosine);
    }
  });
  return errors;
}

}  // namespace glintmark
