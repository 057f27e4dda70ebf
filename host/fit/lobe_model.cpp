#include "host/fit/lobe_model.h"

#include <algorithm>

#include "host/core/angles.h"
#include "host/reference/microfacet.h"

namespace glintmark {
namespace {

double cubic(const std::array<double, 4>& c, double x) {
  return c[0] + x * (c[1] + x * (c[2] + x * c[3]));
}

}  // namespace

const LobePolynomials kPublishedCode = {
    .scale = {{{0.028813261153483097, -0.9215374811620882, 6.632726114385572, -4.5957022306534},
               {-0.09663259042197028, 7.214143602200921, -19.786845117100626, 11.042058883797509},
               {0.10935692546815767, -10.790405157520944, 28.50803667636733, -15.665258273262731},
               {-0.04376425480146207, 5.2491960091879, -13.582707339717146, 7.348408854602616}}},
    .exponent = {2.588380909161985, -1.3549594389004276},
    .flattening = {{{0.8850557867448499, -1.2109761138443194, 0.22569832413951335,
                     0.4498256199595464},
                    {0.0856807009397115, 0.5659031384072539, 0, 0},
                    {-0.07707463071513312, -1.384614678037336, 0.8565888280926491, 0},
                    {0.010423083821992304, 0.8525591060832015, -0.6844738691665317, 0}}},
    .third_order = 0.363902052363025};

const LobePolynomials kPublishedText = {.scale = kPublishedCode.scale,
                                        .exponent = {2.5958, -1.32697},
                                        .flattening = {{{0.9136430, -1.655480, 1.39617, -0.320331},
                                                        {0.0447239, 0.624740, 0, 0},
                                                        {-0.1188440, -0.973213, 0.36902, 0},
                                                        {0.1325770, 0.169750, 0, 0}}},
                                        .third_order = 0.363902052363025};

double LobePolynomials::thirdOverSecond(double alpha) const {
  const double square = alpha * alpha;
  return third_order_knee > 0 ? third_order * square / (square + third_order_knee) : third_order;
}

Lobe lobeAt(const LobePolynomials& p, double mu, double alpha) {
  const auto surface = [&](const std::array<std::array<double, 4>, 4>& c) {
    return cubic({cubic(c[0], alpha), cubic(c[1], alpha), cubic(c[2], alpha), cubic(c[3], alpha)},
                 mu);
  };
  Lobe lobe;
  lobe.scale = std::max(surface(p.scale), 0.0);
  lobe.exponent = std::max(alpha * (p.exponent[0] + alpha * p.exponent[1]), 0.0);
  lobe.flattening = std::clamp(surface(p.flattening), 0.05, 4.0);
  lobe.masking = p.masking;
  lobe.alpha = alpha;
  lobe.mu_in = mu;
  return lobe;
}

double smithMasking(double mu, double alpha) {
  const glm::dvec3 w(std::sqrt(std::max(1 - mu * mu, 0.0)), 0, mu);
  const double lambda = reference::lambdaTimesCosine(reference::Ndf::kBeckmann, w, alpha,
                                                     reference::SmithForm::kRational);
  return lambda > 0 ? mu / (mu + lambda) : 1;
}

double maskingFactor(double m, double alpha, double mu_in, double mu_out) {
  return 1 - m + m * smithMasking(mu_in, alpha) * smithMasking(mu_out, alpha);
}

double lobeEnergy(const Lobe& lobe, double mu_out) {
  return maskingFactor(lobe.masking, lobe.alpha, lobe.mu_in, mu_out) *
         lobeEnergy(lobe.scale, lobe.exponent, lobe.flattening, mu_out);
}

double lobeShare(const Lobe& lobe) {
  // Midpoint rule over mu = t^2, which tames mu^eta at 0.
  constexpr int kSteps = 256;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const double t = (i + 0.5) / kSteps;
    sum += 2 * t * lobeEnergy(lobe, t * t);
  }
  return 2 * kPi * sum / kSteps;
}

double lobeModelShare(const LobePolynomials& p, double alpha, double albedo, double mu_in,
                      int order) {
  const double second = lobeShare(lobeAt(p, mu_in, alpha));
  if (order == 1) return albedo * std::max(1 - second * (1 + p.thirdOverSecond(alpha)), 0.0);
  if (order == 2) return albedo * albedo * second;
  return order == 3 ? albedo * albedo * albedo * p.thirdOverSecond(alpha) * second : 0;
}

namespace {

// Midpoint rule over cosines of incidence, weighted by the cosine.
constexpr int kIncidences = 48;

double midpoint(int i) {
  return (i + 0.5) / kIncidences;
}

}  // namespace

LobeModel::LobeModel(const LobePolynomials& polynomials, double alpha)
    : polynomials_(polynomials), alpha_(alpha), third_(polynomials.thirdOverSecond(alpha)) {
  for (int i = 0; i < kIncidences; ++i) {
    const double mu = midpoint(i);
    lobes_.push_back(lobeAt(polynomials, mu, alpha));
    scattered_ += 2 * mu * (1 - lobeModelShare(polynomials, alpha, 1, mu, 1)) / kIncidences;
  }
}

LobeModel::Means LobeModel::means(double mu_out) const {
  Means means;
  const double weight = (1 + third_) * 2 * kPi / kIncidences;
  for (int i = 0; i < kIncidences; ++i) {
    const Lobe& lobe = lobes_[static_cast<std::size_t>(i)];
    const double energy = weight * midpoint(i) *
                          lobeEnergy(lobe.scale, 0.0, lobe.flattening, mu_out) *
                          (2 + lobe.exponent) / 2;
    means.plain += energy;
    means.masked += energy * smithMasking(midpoint(i), alpha_);
  }
  return means;
}

double LobeModel::energy(double albedo, double mu_in, double mu_out) const {
  const Lobe lobe = lobeAt(polynomials_, mu_in, alpha_);
  const double single = lobeModelShare(polynomials_, alpha_, albedo, mu_in, 1);
  const double colour = albedo * albedo * (1 + third_ * albedo);
  if (mu_out <= 0) return colour * lobeEnergy(lobe, 0);
  // What a white furnace would show of the higher orders: mean radiance times mu^(eta - 1).
  const Means mean = means(mu_out);
  const double m = polynomials_.masking;
  const double furnace = std::pow(mu_out, lobe.exponent - 1) *
                         ((1 - m) * mean.plain + m * smithMasking(mu_out, alpha_) * mean.masked);
  const double room = furnace > scattered_ ? scattered_ / furnace : 1;
  return single * mu_out / kPi + colour * room * lobeEnergy(lobe, mu_out);
}

double eonAlbedo(double mu, double r) {
  // [EON] Eq. 14, with G(theta) of Eq. 13.
  const double a_f = 1 / (1 + (0.5 - 2 / (3 * kPi)) * r);
  const double si = std::sqrt(std::max(1 - mu * mu, 0.0));
  const double tangent_term =
      mu > 1e-9 ? 2.0 / 3.0 * (si / mu) * (1 - si * si * si) - 2.0 / 3.0 * si : -2.0 / 3.0 * si;
  const double g = si * (std::acos(std::clamp(mu, -1.0, 1.0)) - si * mu) + tangent_term;
  return a_f + r * a_f / kPi * g;
}

EonValue eonBrdf(const glm::dvec3& in, const glm::dvec3& out, double r, double albedo) {
  const double a_f = 1 / (1 + (0.5 - 2 / (3 * kPi)) * r);
  const double s = glm::dot(in, out) - in.z * out.z;
  const double t = s > 0 ? s / std::max({in.z, out.z, 1e-9}) : s;
  EonValue value;
  value.single = albedo / kPi * a_f * (1 + r * t);
  // Its mean albedo, [EON] Eq. 16, and the energy that is missing given back.
  const double mean = a_f * (1 + (2.0 / 3.0 - 28 / (15 * kPi)) * r);
  const double colour = albedo * albedo * mean / (1 - albedo * std::max(1 - mean, 0.0));
  value.multiple = colour / kPi * std::max(1 - eonAlbedo(in.z, r), 0.0) *
                   std::max(1 - eonAlbedo(out.z, r), 0.0) / std::max(1 - mean, 1e-7);
  return value;
}

double firstOrder(const FirstOrder& c, double mu_in, double mu_out, double azimuth) {
  const double s = std::sqrt(std::max(1 - mu_in * mu_in, 0.0)) *
                   std::sqrt(std::max(1 - mu_out * mu_out, 0.0)) * std::cos(azimuth);
  const double towards = std::max(s, 0.0);
  return std::max(c[0] + c[1] * towards / std::max({mu_in, mu_out, 1e-6}) +
                      c[2] * std::min(s, 0.0) + c[3] * (mu_in + mu_out) + c[4] * mu_in * mu_out +
                      c[5] * towards,
                  0.0);
}

FirstOrder ScatterFit::at(double alpha) const {
  const double square = alpha * alpha, x = square > 0 ? square / (square + knee) : 0;
  FirstOrder c{1};
  for (std::size_t i = 0; i < kFirstOrderTerms; ++i) c[i] += x * (first[0][i] + x * first[1][i]);
  return c;
}

ScatterModel::ScatterModel(const FirstOrder& first) : first_(first) {
  mean_ = 0;
  for (int i = 0; i < kIncidences; ++i)
    mean_ += 2 * midpoint(i) * albedo(midpoint(i)) / kIncidences;
}

double ScatterModel::albedo(double mu) const {
  // Means over azimuths in closed form: of max(s, 0) the product of both sines over pi.
  const double sine = std::sqrt(std::max(1 - mu * mu, 0.0));
  double sum = 0;
  for (int i = 0; i < 4 * kIncidences; ++i) {
    const double out = (i + 0.5) / (4 * kIncidences);
    const double across = sine * std::sqrt(1 - out * out) / kPi;
    sum += 2 * out *
           (first_[0] + first_[1] * across / std::max({mu, out, 1e-6}) - first_[2] * across +
            first_[3] * (mu + out) + first_[4] * mu * out + first_[5] * across);
  }
  return std::min(sum / (4 * kIncidences), 1.0);
}

// The integral of 2 mu sin(mu) / pi over the hemisphere's cosines is 2 / (3 pi).
double ScatterModel::sineShare() const {
  return (first_[1] - first_[2] + first_[5]) * 2 / (3 * kPi);
}

double ScatterModel::energy(double albedo, double mu_in, double mu_out, double azimuth) const {
  const double colour = albedo * albedo * mean_ / (1 - albedo * std::max(1 - mean_, 0.0));
  const double lost = (1 - this->albedo(mu_in)) * (1 - this->albedo(mu_out));
  return mu_out / kPi *
         (albedo * firstOrder(first_, mu_in, mu_out, azimuth) +
          colour * lost / std::max(1 - mean_, 1e-7));
}

double EonRoughness::at(double alpha) const {
  const double square = alpha * alpha;
  return square > 0 ? std::clamp(top * square / (square + knee), 0.0, 1.0) : 0;
}

}  // namespace glintmark
