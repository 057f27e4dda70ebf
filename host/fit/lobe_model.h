// Analytic models of a rough diffuse surface, in double precision: what the kernels approximate.
//
// [PAT18] "Analytical Fit of Diffuse Lobes". [EON] Portsmouth, Kutz, Hill, "EON: A Practical
// Energy-Preserving Rough Diffuse BRDF", JCGT 14(1), 2025.
#pragma once
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <vector>

namespace glintmark {

/// Coefficients of the lobes of scattering orders 2 and 3. [PAT18] "Parameters Fitting";
/// polynomials in the roughness, lowest power first.
struct LobePolynomials {
  std::array<std::array<double, 4>, 4> scale{};       // sigma: of mu^0 to mu^3
  std::array<double, 2> exponent{};                   // eta: of alpha, alpha^2
  std::array<std::array<double, 4>, 4> flattening{};  // sigma_n: of mu^0 to mu^3
  double third_order =
      0;  // order 3 over order 2 at albedo 1: third_order alpha^2 / (alpha^2 + knee)
  double third_order_knee = 0;  // [PAT18] has the same ratio for all roughness
  double masking = 0;  // m, importance of masking and shadowing, [0, 1]; [PAT18] ends with 0

  double thirdOverSecond(double alpha) const;
};

/// The coefficients of the code that [PAT18] gives, and those of its text, which belong to another
/// fit. The text's scale goes with 1 / (2 pi), which halves the energy; like its code we take 1 /
/// pi.
extern const LobePolynomials kPublishedCode, kPublishedText;

/// A lobe's parameters for one incidence and roughness.
struct Lobe {
  double scale = 0, exponent = 1, flattening = 1;
  double masking = 0, alpha = 0, mu_in = 1;  // of the factor for masking and shadowing
};

/// G(mu, alpha) of one direction: Smith's masking for Beckmann slopes, rational fit of [Walter07]
/// ("Microfacet Models for Refraction through Rough Surfaces", EGSR 2007). 1 for alpha 0.
double smithMasking(double mu, double alpha);
/// What masking and shadowing of importance m leave: (1 - m) + m G(mu_in) G(mu_out).
/// [PAT18] "Analytical Lobe Expression"
double maskingFactor(double m, double alpha, double mu_in, double mu_out);

/// Evaluates the polynomials for the cosine of incidence `mu`, 0 to 1; scale is cut off at 0, where
/// the published one is negative, and flattening kept in [0.05, 4].
Lobe lobeAt(const LobePolynomials& polynomials, double mu, double alpha);

/// Share of the incident energy per unit solid angle towards the cosine `mu_out`, at albedo 1:
/// sigma (2 + eta) / pi mu^eta L(mu) / (2 pi). Templates serve automatic differentiation.
template <typename T>
T lobeEnergy(const T& scale, const T& exponent, const T& flattening, const T& mu_out) {
  using std::pow;
  using std::sqrt;
  const T squash = 1.0 / (flattening * flattening) - 1.0;
  const T shape = pow(mu_out, exponent) / sqrt(1.0 + mu_out * mu_out * squash);
  return scale * (2.0 + exponent) * shape / (2.0 * std::numbers::pi * std::numbers::pi);
}

/// The same for a lobe, with its masking.
double lobeEnergy(const Lobe& lobe, double mu_out);
/// That energy over the hemisphere: the share of an order.
double lobeShare(const Lobe& lobe);

/// What leaves in order 1, 2 or 3, over the hemisphere: order 1 is what the others leave over, so
/// that they never add up to more than came in.
double lobeModelShare(const LobePolynomials& polynomials, double alpha, double albedo, double mu_in,
                      int order);

/// The run-time model of one roughness: single scattering is a Lambertian lobe, and the lobes of
/// higher orders are cut off where they would make a white furnace brighter than white. They are
/// not reciprocal, so that towards the horizon they would.
class LobeModel {
 public:
  LobeModel(const LobePolynomials& polynomials, double alpha);

  /// Energy per solid angle.
  double energy(double albedo, double mu_in, double mu_out) const;
  /// Share of the light of a white furnace that leaves after more than one bounce, at albedo 1.
  double scattered() const { return scattered_; }
  /// Radiance that the higher orders would send out of a white furnace at albedo 1, over
  /// mu_out^(eta - 1): without masking, and masked on the way in alone.
  struct Means {
    double plain = 0, masked = 0;
  };
  Means means(double mu_out) const;

 private:
  LobePolynomials polynomials_;
  double alpha_, third_, scattered_ = 0;
  std::vector<Lobe> lobes_;  // at fixed cosines of incidence
};

/// [EON]: the BRDF of roughness r in [0, 1], single and multiple scattering, for unit directions.
struct EonValue {
  double single = 0, multiple = 0;
};
EonValue eonBrdf(const glm::dvec3& in, const glm::dvec3& out, double r, double albedo);
/// Directional albedo of its single scattering at albedo 1, exact.
double eonAlbedo(double mu, double r);
/// A model of ours that is reciprocal and loses nothing: single scattering is Lambert's times a sum
/// of six terms of both cosines and of s = w_in . w_out - mu_in mu_out,
///   c0 + c1 max(s, 0) / max(mu_in, mu_out) + c2 min(s, 0) + c3 (mu_in + mu_out)
///      + c4 mu_in mu_out + c5 max(s, 0);
/// what it leaves of the energy is given back as [EON] does.
inline constexpr std::size_t kFirstOrderTerms = 6;
using FirstOrder = std::array<double, kFirstOrderTerms>;
/// The sum for directions of these cosines, `azimuth` apart; at least 0.
double firstOrder(const FirstOrder& c, double mu_in, double mu_out, double azimuth);

/// The fitted coefficients: c = (1, 0, ...) + x first[0] + x^2 first[1], x = alpha^2 / (alpha^2 +
/// knee).
struct ScatterFit {
  std::array<FirstOrder, 2> first{};
  double knee = 1;

  FirstOrder at(double alpha) const;
};

/// The model of one roughness.
class ScatterModel {
 public:
  explicit ScatterModel(const FirstOrder& first);

  /// What single scattering keeps of the energy at albedo 1, of the cosine of incidence; and its
  /// mean over a white furnace.
  double albedo(double mu) const;
  double meanAlbedo() const { return mean_; }
  /// What the albedo has of the sine of incidence, at normal incidence: the rest is smooth there.
  double sineShare() const;
  /// Energy per solid angle.
  double energy(double albedo, double mu_in, double mu_out, double azimuth) const;

 private:
  FirstOrder first_;
  double mean_ = 1;
};

/// The roughness r of EON that stands for Beckmann roughness alpha: top alpha^2 / (alpha^2 + knee),
/// the form of Oren and Nayar's own B of the slope variance, at most 1. The numbers are fitted.
struct EonRoughness {
  double top = 1, knee = 0;

  double at(double alpha) const;
};

}  // namespace glintmark
