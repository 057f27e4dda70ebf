#include "host/fit/anisotropic_error.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "host/fit/anisotropic_lobe.h"
#include "host/fit/ltc_lobe.h"

namespace glintmark {
namespace {

// All places of a grid of `count` nodes an axis, the first at node `first`.
std::vector<AnisotropicErrorAt> errorsOver(const AnisotropicTable& table, const LtcTable& round,
                                           int count, double first) {
  const int whole = count * count * count * count;
  std::vector<AnisotropicErrorAt> errors(static_cast<std::size_t>(whole));
  tbb::parallel_for(0, whole, [&](int i) {
    const AnisotropicView view = anisotropicViewAt(
        table.ndf, {first + i % count, first + i / count % count,
                    first + i / (count * count) % count, first + i / (count * count * count)});
    errors[static_cast<std::size_t>(i)] = anisotropicErrorAt(table, round, view);
  });
  return errors;
}

}  // namespace

AnisotropicErrorAt anisotropicErrorAt(const AnisotropicTable& table, const LtcTable& round,
                                      const AnisotropicView& view) {
  const auto errorOf = [&](const glm::dmat3& inverse) {
    const AnisotropicSamples samples = makeAnisotropicSamples(view, inverse);
    return samples.albedo * anisotropicError(samples, inverse);
  };
  const double alpha = std::sqrt(view.alpha.x * view.alpha.y);
  return {
      view.alpha.y / view.alpha.x, view.cos_theta,
      errorOf(glm::inverse(anisotropicMatrix(lookUpAnisotropic(table, view), view))),
      errorOf(ltcInverseMatrix(lookUpLtc(round, alpha, view.cos_theta), alpha, view.cos_theta))};
}

std::vector<AnisotropicErrorAt> anisotropicNodeErrors(const AnisotropicTable& table,
                                                      const LtcTable& round) {
  return errorsOver(table, round, ANISO_NODES, 0);
}

std::vector<AnisotropicErrorAt> anisotropicMidpointErrors(const AnisotropicTable& table,
                                                          const LtcTable& round) {
  return errorsOver(table, round, ANISO_NODES - 1, 0.5);
}

}  // namespace glintmark
