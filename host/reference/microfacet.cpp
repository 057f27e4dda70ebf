#include "host/reference/microfacet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/reference/beckmann.h"

namespace glintmark::reference {
namespace {

// Lambda(w) w.z, which stays finite at the horizon: there it is alpha / 2 (GGX) or
// alpha / (2 sqrt(pi)) (Beckmann).
double lambdaTimesCosine(Ndf ndf, const glm::dvec3& w, double alpha) {
  const double z = std::max(w.z, 0.0), sine_sq = w.x * w.x + w.y * w.y;
  if (ndf == Ndf::kGgx) {
    const double alpha_sine_sq = alpha * alpha * sine_sq;
    // (sqrt(z^2 + a^2 s^2) - z) / 2 without cancellation.
    const double sum = std::sqrt(z * z + alpha_sine_sq) + z;
    return sum > 0 ? 0.5 * alpha_sine_sq / sum : 0;
  }
  const double alpha_sine = alpha * std::sqrt(sine_sq);
  if (alpha_sine <= 0) return 0;
  const double a = z / alpha_sine;
  const double value =
      std::exp(-a * a) * alpha_sine / std::sqrt(std::numbers::pi) - z * std::erfc(a);
  return std::max(0.5 * value, 0.0);  // cancels for large a
}

}  // namespace

std::string ndfName(Ndf ndf) {
  return ndf == Ndf::kGgx ? "ggx" : "beckmann";
}

double microfacetDensity(Ndf ndf, const glm::dvec3& m, double alpha) {
  if (m.z <= 0) return 0;
  if (ndf == Ndf::kBeckmann) return reference::ndf(m, glm::dvec2(alpha));
  const double sine_sq = m.x * m.x + m.y * m.y;  // not 1 - z^2, which cancels near the normal
  const double root = m.z * m.z + sine_sq / (alpha * alpha);
  return 1 / (std::numbers::pi * alpha * alpha * root * root);
}

double microfacetLambda(Ndf ndf, const glm::dvec3& w, double alpha) {
  return lambdaTimesCosine(ndf, w, alpha) / w.z;
}

double microfacetTimesCosine(Ndf ndf, const glm::dvec3& i, const glm::dvec3& o, double alpha) {
  if (i.z <= 0 || o.z < 0) return 0;
  const glm::dvec3 sum = i + o;
  const glm::dvec3 m = sum / std::sqrt(glm::dot(sum, sum));
  // G2 / o.z = i.z / (i.z o.z + i.z L(o) o.z + o.z L(i) i.z), finite for a grazing view.
  const double lambda_o = lambdaTimesCosine(ndf, o, alpha);
  const double lambda_i = lambdaTimesCosine(ndf, i, alpha);
  const double masking = i.z / (i.z * (o.z + lambda_o) + o.z * lambda_i);
  return 0.25 * microfacetDensity(ndf, m, alpha) * masking;
}

}  // namespace glintmark::reference
