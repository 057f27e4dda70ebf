#include "host/fit/lobe_fit.h"

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "host/core/angles.h"

namespace glintmark {
namespace {

constexpr int kCells = LobeData::kCosines * LobeData::kAzimuths;

template <typename T>
T freeEnergy(const T* p, double mask, double cosine, double azimuth) {
  using std::cos;
  using std::sin;
  // The axis leans in the plane of incidence; the light comes from azimuth 0.
  const double sine = std::sqrt(1 - cosine * cosine);
  T mu = cosine * cos(p[3]) + sine * std::cos(azimuth) * sin(p[3]);
  if (mu < 1e-4) mu = T(1e-4);
  return (1.0 - p[4] + p[4] * mask) * lobeEnergy(p[0], p[1], p[2], mu);
}

// The factor for masking and shadowing of full importance.
double maskingPair(double alpha, double mu_in, double cosine) {
  return maskingFactor(1, alpha, mu_in, cosine);
}

// One histogram against one free lobe.
struct FreeCost {
  const LobeData& data;
  double scale;

  template <typename T>
  bool operator()(const T* const p, T* residuals) const {
    for (int i = 0; i < kCells; ++i) {
      const double cosine = LobeData::cosine(i / LobeData::kAzimuths);
      const double azimuth = LobeData::azimuth(i % LobeData::kAzimuths);
      const double mask = maskingPair(data.alpha, data.mu_in, cosine);
      residuals[i] =
          (freeEnergy(p, mask, cosine, azimuth) - data.energy[static_cast<std::size_t>(i)]) * scale;
    }
    return true;
  }
};

// The coefficients in the order of LobePolynomials. Those that [PAT18] has no power for stay 0.
constexpr int kScale = 0, kExponent = 16, kFlattening = 18, kThird = 34, kKnee = 35, kMasking = 36;
constexpr int kCoefficients = 37;

constexpr double kFirstKnee = 0.5;  // of order 3 over order 2, about where simulations bend

double surfaceAt(const double* c, double mu, double alpha) {
  double sum = 0;
  double mu_power = 1;
  for (int i = 0; i < 4; ++i, mu_power *= mu) {
    const double* row = c + 4 * i;
    sum += mu_power * (row[0] + alpha * (row[1] + alpha * (row[2] + alpha * row[3])));
  }
  return sum;
}

// One order of one simulation, averaged over azimuths, against the polynomials.
struct PolynomialCost {
  const LobeData& data;

  bool operator()(const double* const c, double* residuals) const {
    const double scale = surfaceAt(c + kScale, data.mu_in, data.alpha);
    const double exponent = data.alpha * (c[kExponent] + data.alpha * c[kExponent + 1]);
    const double flattening = surfaceAt(c + kFlattening, data.mu_in, data.alpha);
    if (exponent < 0 || flattening < 0.05) return false;
    const double square = data.alpha * data.alpha;
    const double order = data.order == 3 ? c[kThird] * square / (square + c[kKnee]) : 1.0;
    for (int row = 0; row < LobeData::kCosines; ++row) {
      double mean = 0;
      const auto first = data.energy.begin() + row * LobeData::kAzimuths;
      for (int column = 0; column < LobeData::kAzimuths; ++column) mean += first[column];
      mean /= LobeData::kAzimuths;
      const double cosine = LobeData::cosine(row);
      residuals[row] = order * maskingFactor(c[kMasking], data.alpha, data.mu_in, cosine) *
                           lobeEnergy(scale, exponent, flattening, cosine) -
                       mean;
    }
    // A scale below 0 costs; the kernel would cut it off.
    residuals[LobeData::kCosines] = std::min(scale, 0.0);
    return true;
  }
};

// All orders of one simulation against EON.
struct EonCost {
  const LobeData& data;

  bool operator()(const double* const p, double* residuals) const {
    const double r = EonRoughness{p[0], p[1]}.at(data.alpha);
    for (int i = 0; i < kCells; ++i)
      residuals[i] = eonEnergy(r, data.mu_in, LobeData::cosine(i / LobeData::kAzimuths),
                               LobeData::azimuth(i % LobeData::kAzimuths)) -
                     data.energy[static_cast<std::size_t>(i)];
    return true;
  }
};

constexpr int kFirstOrderFit = 2 * static_cast<int>(kFirstOrderTerms) + 1;

ScatterFit scatterFitOf(const double* c) {
  ScatterFit fit;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t i = 0; i < kFirstOrderTerms; ++i)
      fit.first[k][i] = c[k * kFirstOrderTerms + i];
  fit.knee = c[kFirstOrderFit - 1];
  return fit;
}

// One simulation against the reciprocal model: its single scattering, or all of it.
struct ScatterCost {
  const LobeData& data;

  bool operator()(const double* const c, double* residuals) const {
    const FirstOrder first = scatterFitOf(c).at(data.alpha);
    const double scale = 2 * kPi / std::max(data.share, 1e-3);
    std::array<double, LobeData::kCosines> multiple{};
    if (data.order == 0) {
      const ScatterModel model(first);
      const double lost = (1 - model.albedo(data.mu_in)) / std::max(1 - model.meanAlbedo(), 1e-7);
      for (int row = 0; row < LobeData::kCosines; ++row)
        multiple[static_cast<std::size_t>(row)] = lost * (1 - model.albedo(LobeData::cosine(row)));
    }
    for (int i = 0; i < kCells; ++i) {
      const int row = i / LobeData::kAzimuths;
      const double cosine = LobeData::cosine(row);
      const double sum =
          firstOrder(first, data.mu_in, cosine, LobeData::azimuth(i % LobeData::kAzimuths)) +
          multiple[static_cast<std::size_t>(row)];
      residuals[i] = scale * (sum * cosine / kPi - data.energy[static_cast<std::size_t>(i)]);
    }
    return true;
  }
};

ceres::Solver::Options solverOptions() {
  ceres::Solver::Options options;
  options.max_num_iterations = 200;
  options.linear_solver_type = ceres::DENSE_QR;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  return options;
}

}  // namespace

LobeData makeLobeData(const Simulation& simulation, int order, int side) {
  LobeData data;
  data.alpha = simulation.settings.alpha.x;
  data.mu_in = std::cos(glm::radians(simulation.settings.incidence_deg));
  data.order = order;
  data.energy.assign(kCells, 0.0);
  constexpr int kRows = static_cast<int>(HF_COSINES) / LobeData::kCosines;
  constexpr int kHalf = static_cast<int>(HF_AZIMUTHS) / 2;
  constexpr int kColumns = kHalf / LobeData::kAzimuths;
  const int first = order == 0 ? 1 : order;
  const int last = order == 0 ? simulation.settings.orders : order;
  for (int o = first; o <= last; ++o)
    for (int row = 0; row < static_cast<int>(HF_COSINES); ++row)
      for (int column = 0; column < 2 * kHalf; ++column) {
        const int folded = column < kHalf ? column : 2 * kHalf - 1 - column;
        const int cell = row / kRows * LobeData::kAzimuths + folded / kColumns;
        data.energy[static_cast<std::size_t>(cell)] += static_cast<double>(simulation.cell(
            side, o, static_cast<std::size_t>(row), static_cast<std::size_t>(column)));
      }
  const double rays = static_cast<double>(simulation.rays_done);
  for (double& energy : data.energy) {
    data.share += energy / rays;
    energy *= kCells / (rays * 2 * kPi);
  }
  return data;
}

double cellEnergy(const LobeData& data, double cosine, double azimuth) {
  const double folded = azimuth > kPi ? 2 * kPi - azimuth : azimuth;
  const int row =
      std::clamp(static_cast<int>((1 - cosine) * LobeData::kCosines), 0, LobeData::kCosines - 1);
  const int column =
      std::clamp(static_cast<int>(folded / kPi * LobeData::kAzimuths), 0, LobeData::kAzimuths - 1);
  const int cell = row * LobeData::kAzimuths + column;
  return data.energy[static_cast<std::size_t>(cell)];
}

FreeLobe fitLobe(const LobeData& data, bool masking, double deviation_rad, double exponent) {
  FreeLobe lobe;
  if (data.share <= 0) return lobe;
  const double mean = data.share / (2 * kPi);
  double p[5] = {data.share * kPi, exponent, 0.9, deviation_rad, masking ? 0.1 : 0};
  ceres::Problem problem;
  problem.AddResidualBlock(new ceres::AutoDiffCostFunction<FreeCost, kCells, 5>(
                               new FreeCost{data, 1 / (mean * std::sqrt(kCells))}),
                           nullptr, p);
  const double low[5] = {0, 0, 0.1, -1.2, 0}, high[5] = {100, 1023, 4, 1.2, 1};
  for (int i = 0; i < 5; ++i) {
    problem.SetParameterLowerBound(p, i, low[i]);
    problem.SetParameterUpperBound(p, i, high[i]);
  }
  if (!masking) problem.SetManifold(p, new ceres::SubsetManifold(5, {4}));
  ceres::Solver::Summary summary;
  ceres::Solve(solverOptions(), &problem, &summary);
  lobe = {p[0], p[1], p[2], p[3], p[4], std::sqrt(2 * summary.final_cost)};
  return lobe;
}

double freeLobeEnergy(const FreeLobe& lobe, double alpha, double mu_in, double cosine,
                      double azimuth) {
  const double p[5] = {lobe.scale, lobe.exponent, lobe.flattening, lobe.deviation_rad,
                       lobe.masking};
  return freeEnergy(p, maskingPair(alpha, mu_in, cosine), cosine, azimuth);
}

LobePolynomials fitPolynomials(const std::vector<LobeData>& data, bool masking) {
  double c[kCoefficients];
  // One after another, as in [PAT18]: masking comes last.
  const LobePolynomials start = masking ? fitPolynomials(data) : kPublishedCode;
  std::vector<int> fixed;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
      c[kScale + 4 * i + j] = start.scale[row][column];
      c[kFlattening + 4 * i + j] = start.flattening[row][column];
      if (start.flattening[row][column] == 0) fixed.push_back(kFlattening + 4 * i + j);
    }
  c[kExponent] = start.exponent[0];
  c[kExponent + 1] = start.exponent[1];
  c[kThird] = start.third_order;
  c[kKnee] = masking ? start.third_order_knee : kFirstKnee;
  c[kMasking] = masking ? 0.1 : 0;
  if (!masking) fixed.push_back(kMasking);
  ceres::Problem problem;
  for (const LobeData& one : data)
    if (one.order == 2 || one.order == 3)
      problem.AddResidualBlock(
          new ceres::NumericDiffCostFunction<PolynomialCost, ceres::CENTRAL, LobeData::kCosines + 1,
                                             kCoefficients>(new PolynomialCost{one}),
          nullptr, c);
  problem.SetParameterLowerBound(c, kKnee, 1e-9);
  problem.SetParameterLowerBound(c, kMasking, 0);
  problem.SetParameterUpperBound(c, kMasking, 1);
  problem.SetManifold(c, new ceres::SubsetManifold(kCoefficients, fixed));
  ceres::Solver::Summary summary;
  ceres::Solve(solverOptions(), &problem, &summary);
  LobePolynomials result;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      result.scale[i][j] = c[kScale + 4 * i + j];
      result.flattening[i][j] = c[kFlattening + 4 * i + j];
    }
  result.exponent = {c[kExponent], c[kExponent + 1]};
  result.third_order = c[kThird];
  result.third_order_knee = c[kKnee];
  result.masking = c[kMasking];
  return result;
}

double eonEnergy(double r, double mu_in, double cosine, double azimuth, double albedo) {
  const double sine_in = std::sqrt(1 - mu_in * mu_in), sine = std::sqrt(1 - cosine * cosine);
  const EonValue value = eonBrdf(
      {sine_in, 0, mu_in}, {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine}, r, albedo);
  return (value.single + value.multiple) * cosine;
}

ScatterFit fitScatter(const std::vector<LobeData>& data, const std::vector<LobeData>& totals) {
  double c[kFirstOrderFit] = {};
  c[kFirstOrderFit - 1] = 0.3;  // about where simulations bend
  ceres::Problem problem;
  const auto add = [&](const LobeData& one) {
    problem.AddResidualBlock(
        new ceres::NumericDiffCostFunction<ScatterCost, ceres::CENTRAL, kCells, kFirstOrderFit>(
            new ScatterCost{one}),
        nullptr, c);
  };
  for (const LobeData& one : data)
    if (one.order == 1) add(one);
  for (const LobeData& one : totals) add(one);
  problem.SetParameterLowerBound(c, kFirstOrderFit - 1, 0.01);
  problem.SetParameterUpperBound(c, kFirstOrderFit - 1, 10);
  ceres::Solver::Summary summary;
  ceres::Solve(solverOptions(), &problem, &summary);
  return scatterFitOf(c);
}

EonRoughness fitEonRoughness(const std::vector<LobeData>& totals) {
  double p[2] = {0.7, 0.3};
  ceres::Problem problem;
  for (const LobeData& one : totals)
    problem.AddResidualBlock(
        new ceres::NumericDiffCostFunction<EonCost, ceres::CENTRAL, kCells, 2>(new EonCost{one}),
        nullptr, p);
  problem.SetParameterLowerBound(p, 0, 0);
  problem.SetParameterUpperBound(p, 0, 2);
  problem.SetParameterLowerBound(p, 1, 0);
  problem.SetParameterUpperBound(p, 1, 10);
  ceres::Solver::Summary summary;
  ceres::Solve(solverOptions(), &problem, &summary);
  return {p[0], p[1]};
}

double lobeError(const LobeData& data, const std::function<double(double, double)>& model) {
  double sum = 0;
  for (int i = 0; i < kCells; ++i) {
    const double difference = model(LobeData::cosine(i / LobeData::kAzimuths),
                                    LobeData::azimuth(i % LobeData::kAzimuths)) -
                              data.energy[static_cast<std::size_t>(i)];
    sum += difference * difference;
  }
  return data.share > 0 ? std::sqrt(sum / kCells) / (data.share / (2 * kPi)) : 0;
}

}  // namespace glintmark
