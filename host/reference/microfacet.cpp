#include "host/reference/microfacet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/reference/beckmann.h"

namespace glintmark::reference {
std::string ndfName(Ndf ndf) {
  if (ndf == Ndf::kNormals) return "normals";
  return ndf == Ndf::kGgx ? "ggx" : "beckmann";
}

double microfacetDensity(Ndf ndf, const glm::dvec3& m, const glm::dvec2& alpha) {
  if (m.z <= 0) return 0;
  if (ndf != Ndf::kGgx) return reference::ndf(m, alpha);
  const glm::dvec2 stretched = glm::dvec2(m) / alpha;  // not 1 - z^2, which cancels near the normal
  const double root = m.z * m.z + glm::dot(stretched, stretched);
  return 1 / (std::numbers::pi * alpha.x * alpha.y * root * root);
}

double microfacetDensity(Ndf ndf, const glm::dvec3& m, double alpha) {
  return microfacetDensity(ndf, m, glm::dvec2(alpha));
}

// At the horizon it is alpha / 2 (GGX) or alpha / (2 sqrt(pi)) (Beckmann).
double lambdaTimesCosine(Ndf ndf, const glm::dvec3& w, const glm::dvec2& alpha, SmithForm form) {
  if (ndf == Ndf::kNormals) return 0;
  const double z = std::max(w.z, 0.0);
  const glm::dvec2 seen = alpha * glm::dvec2(w);
  const double alpha_sine_sq = glm::dot(seen, seen);
  if (ndf == Ndf::kGgx) {
    // (sqrt(z^2 + a^2 s^2) - z) / 2 without cancellation.
    const double sum = std::sqrt(z * z + alpha_sine_sq) + z;
    return sum > 0 ? 0.5 * alpha_sine_sq / sum : 0;
  }
  const double alpha_sine = std::sqrt(alpha_sine_sq);
  if (alpha_sine <= 0) return 0;
  const double a = z / alpha_sine;
  if (form == SmithForm::kRational)
    return a < 1.6 ? alpha_sine * (1 - a * (1.259 - 0.396 * a)) / (3.535 + 2.181 * a) : 0;
  const double value =
      std::exp(-a * a) * alpha_sine / std::sqrt(std::numbers::pi) - z * std::erfc(a);
  return std::max(0.5 * value, 0.0);  // cancels for large a
}

double lambdaTimesCosine(Ndf ndf, const glm::dvec3& w, double alpha, SmithForm form) {
  return lambdaTimesCosine(ndf, w, glm::dvec2(alpha), form);
}

double microfacetLambda(Ndf ndf, const glm::dvec3& w, double alpha) {
  return lambdaTimesCosine(ndf, w, alpha, SmithForm::kExact) / w.z;
}

double microfacetTimesCosine(Ndf ndf, const glm::dvec3& i, const glm::dvec3& o,
                             const glm::dvec2& alpha, SmithForm form) {
  if (o.z < 0 || (i.z <= 0 && ndf != Ndf::kNormals)) return 0;
  const glm::dvec3 sum = i + o;
  const glm::dvec3 m = sum / std::sqrt(glm::dot(sum, sum));
  if (ndf == Ndf::kNormals) {
    const double density = microfacetDensity(ndf, m, alpha);  // no number where it underflows
    return density > 0 ? density * m.z / (4 * glm::dot(o, m)) : 0;
  }
  // G2 / o.z = i.z / (i.z o.z + i.z L(o) o.z + o.z L(i) i.z), finite for a grazing view.
  const double lambda_o = lambdaTimesCosine(ndf, o, alpha, form);
  const double lambda_i = lambdaTimesCosine(ndf, i, alpha, form);
  const double masking = i.z / (i.z * (o.z + lambda_o) + o.z * lambda_i);
  return 0.25 * microfacetDensity(ndf, m, alpha) * masking;
}

double microfacetTimesCosine(Ndf ndf, const glm::dvec3& i, const glm::dvec3& o, double alpha,
                             SmithForm form) {
  return microfacetTimesCosine(ndf, i, o, glm::dvec2(alpha), form);
}

AlbedoParts microfacetAlbedoParts(Ndf ndf, double mu, double alpha, SmithForm form) {
  // Normals m with quantile u of their slope and azimuth phi: d m = 1 / (D m.z) d(u, phi / 2 pi),
  // and d i = 4 o.m d m. GGX: slope^2 = alpha^2 u / (1 - u); Beckmann: -alpha^2 log(1 - u).
  constexpr int kSlopes = 192, kAzimuths = 96;  // azimuths over half a turn
  const glm::dvec3 o(std::sqrt(std::max(1 - mu * mu, 0.0)), 0, mu);
  AlbedoParts sum;
  for (int k = 0; k < kSlopes; ++k) {
    const double u = (k + 0.5) / kSlopes;
    const double slope_sq = ndf == Ndf::kGgx ? u / (1 - u) : -std::log1p(-u);
    const double slope = alpha * std::sqrt(slope_sq);
    for (int j = 0; j < kAzimuths; ++j) {
      const double phi = (j + 0.5) * std::numbers::pi / kAzimuths;
      const glm::dvec3 m =
          glm::normalize(glm::dvec3(slope * std::cos(phi), slope * std::sin(phi), 1));
      const double cosine = glm::dot(o, m);
      if (cosine <= 0) continue;
      const glm::dvec3 i = 2 * cosine * m - o;
      const double value = microfacetTimesCosine(ndf, i, o, alpha, form) * 4 * cosine /
                           (microfacetDensity(ndf, m, alpha) * m.z);
      sum.mirror += value;
      sum.schlick += value * std::pow(1 - std::min(cosine, 1.0), 5);
    }
  }
  return {sum.mirror / (kSlopes * kAzimuths), sum.schlick / (kSlopes * kAzimuths)};
}

double microfacetAlbedo(Ndf ndf, double mu, double alpha, SmithForm form) {
  return microfacetAlbedoParts(ndf, mu, alpha, form).mirror;
}

CoatedDiffuse::CoatedDiffuse(Ndf ndf, double alpha, const glm::dvec3& f0, double intensity) {
  constexpr int kCosines = 128;
  for (int i = 0; i < kCosines; ++i) {
    const double mu = std::max(static_cast<double>(i) / (kCosines - 1), 1e-4);
    const auto [mirror, schlick] = microfacetAlbedoParts(ndf, mu, alpha, SmithForm::kExact);
    shares_.push_back(glm::max(1.0 - intensity * (f0 * (mirror - schlick) + schlick), 0.0));
  }
}

glm::dvec3 CoatedDiffuse::share(double mu) const {
  const double at = std::clamp(mu, 0.0, 1.0) * static_cast<double>(shares_.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(at), shares_.size() - 2);
  return glm::mix(shares_[i], shares_[i + 1], at - static_cast<double>(i));
}

}  // namespace glintmark::reference
