#include "host/fit/anisotropic_lobe.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "host/core/angles.h"
#include "host/fit/minimize.h"
#include "host/reference/ltc.h"

namespace glintmark {
namespace {

// Entries of E in M^-1 = (1 + E) M0^-1: all steps are in units of the lobe itself. A factor common
// to all entries and a turn about z change nothing, so seven are left: xx, xy = yx, yy, xz, yz, zx,
// zy.
using Steps = std::array<double, 7>;

// What planes count beside the absolute difference.
constexpr double kPlanesWeight = 4;
// And what lobes lean.
constexpr double kLeanWeight = 0.02;

constexpr MinimizeLimits kAnisotropicLimits = {.iterations = 40, .least_gain = 1e-5, .unit = 0.25};

// glm matrices are indexed [column][row].
glm::dmat3 stepMatrix(const Steps& e) {
  glm::dmat3 m(1.0);
  m[0][0] += e[0];
  m[1][0] = m[0][1] = e[1];
  m[1][1] += e[2];
  m[2][0] = e[3];
  m[2][1] = e[4];
  m[0][2] = e[5];
  m[1][2] = e[6];
  return m;
}

struct MassSlope {
  double share = 1;
  glm::dmat3 by_inverse{0.0};  // derivative by entry [column][row] of M^-1
};

// reference::ltcMassAboveHorizon and its derivative: with r row z of M, 0.5 (1 + r_z / |r|), and
// dM = -M d(M^-1) M, so dr = -r d(M^-1) M.
MassSlope massAbove(const glm::dmat3& inverse) {
  const glm::dmat3 forward = glm::inverse(inverse);
  const glm::dvec3 r(forward[0][2], forward[1][2], forward[2][2]);
  const double length = glm::length(r);
  MassSlope mass;
  mass.share = std::max(0.5 * (1 + r.z / length), 1e-6);
  // d share = 0.5 g . dr
  const glm::dvec3 g = (glm::dvec3(0, 0, 1) - r * (r.z / (length * length))) / length;
  const glm::dvec3 forward_g = forward * g;
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      mass.by_inverse[column][row] = -0.5 * r[row] * forward_g[column];
  return mass;
}

// Shares of the lobe on one side of a plane through two directions that the BRDF mirrors, for many
// such planes: what lights that are wider than a thin arc ask for.
class HalfSpaces {
 public:
  HalfSpaces(const AnisotropicSamples& samples) : count_(samples.direction.size()) {
    // Cumulative weights to draw from.
    std::vector<double> upto;
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i)
      upto.push_back(sum += samples.weight[i] * samples.brdf[i]);
    const auto drawn = [&](double u) {
      const auto at = std::upper_bound(upto.begin(), upto.end(), u * sum) - upto.begin();
      return samples.direction[std::min<std::size_t>(static_cast<std::size_t>(at), count_ - 1)];
    };
    for (int k = 0; k < kPlanes; ++k) {
      const double u = (k + 0.5) / kPlanes, golden = 0.6180339887498949 * (k + 0.5);
      const glm::dvec3 normal = glm::normalize(
          glm::cross(drawn(u), drawn(golden - std::floor(golden))) + glm::dvec3(1e-12));
      for (std::size_t i = 0; i < count_; ++i)
        side_.push_back(glm::dot(normal, samples.direction[i]) > 0 ? 1.0f : 0.0f);
    }
  }

  double add(const std::vector<double>& difference, std::vector<double>& push) const {
    double error = 0;
    for (int k = 0; k < kPlanes; ++k) {
      const float* side = side_.data() + static_cast<std::size_t>(k) * count_;
      double share = 0;
#pragma omp simd reduction(+ : share)
      for (std::size_t i = 0; i < count_; ++i) share += side[i] * difference[i];
      const double size = std::sqrt(share * share + kRound * kRound);
      error += size - kRound;
      const double slope = kPlanesWeight / kPlanes * share / size;
#pragma omp simd
      for (std::size_t i = 0; i < count_; ++i) push[i] += slope * side[i];
    }
    return kPlanesWeight / kPlanes * error;
  }

 private:
  static constexpr int kPlanes = 32;
  static constexpr double kRound = 1e-3;
  std::size_t count_;
  std::vector<float> side_;
};

class LobeProblem {
 public:
  LobeProblem(const AnisotropicSamples& samples, const HalfSpaces* halves, const glm::dmat3& start)
      : halves_(halves), start_(start), count_(samples.direction.size()) {
    for (std::size_t i = 0; i < count_; ++i) {
      const glm::dvec3 t = start * samples.direction[i];
      x_.push_back(t.x);
      y_.push_back(t.y);
      z_.push_back(t.z);
      weight_.push_back(samples.weight[i]);
      wanted_.push_back(samples.weight[i] * samples.brdf[i] / samples.albedo);
    }
    difference_.resize(count_);
    push_.resize(count_);
  }

  glm::dmat3 inverse(const Steps& e) const { return stepMatrix(e) * start_; }

  double operator()(const Steps& e, Steps& gradient) const {
    const glm::dmat3 step = stepMatrix(e);
    const double determinant = glm::determinant(step);
    gradient.fill(0);
    // A lobe turned inside out is none.
    if (!(determinant > 1e-6)) return 1e3;
    const MassSlope mass = massAbove(step * start_);
    const double scale = glm::determinant(step * start_) / (kPi * mass.share);
    const double error = differences(step, scale);
    const double shares = halves_->add(difference_, push_);
    pull(step, scale, mass, gradient);
    return error + shares + addLean(e, gradient);
  }

  double absoluteDifference() const {
    const MassSlope mass = massAbove(start_);
    return differences(glm::dmat3(1.0), glm::determinant(start_) / (kPi * mass.share));
  }

 private:
  // Of weighted densities; returns the sum of their absolute values. `push_` becomes its slope in
  // each of them.
  double differences(const glm::dmat3& step, double scale) const {
    double error = 0;
    const double m00 = step[0][0], m01 = step[1][0], m02 = step[2][0];
    const double m10 = step[0][1], m11 = step[1][1], m12 = step[2][1];
    const double m20 = step[0][2], m21 = step[1][2], m22 = step[2][2];
    const double *xs = x_.data(), *ys = y_.data(), *zs = z_.data();
    const double *weights = weight_.data(), *wanteds = wanted_.data();
    double *results = difference_.data(), *pushes = push_.data();
    const int count = static_cast<int>(count_);
#pragma omp simd reduction(+ : error)
    for (int i = 0; i < count; ++i) {
      const double x = xs[i], y = ys[i], z = zs[i];
      const double tx = m00 * x + m01 * y + m02 * z;
      const double ty = m10 * x + m11 * y + m12 * z;
      const double tz = m20 * x + m21 * y + m22 * z;
      const double inverse_q = 1 / (tx * tx + ty * ty + tz * tz);
      const double density = tz > 0 ? scale * inverse_q * inverse_q * weights[i] * tz : 0;
      const double difference = density - wanteds[i];
      results[i] = difference;
      pushes[i] = difference < 0 ? -1 : 1;
      error += difference < 0 ? -difference : difference;
    }
    return error;
  }

  // Columns x and y of M may lean towards its z to little effect where one of them is short; what
  // they lean costs, so that neighbours agree.
  double lean(const Steps& e) const {
    const glm::dmat3 m = glm::inverse(inverse(e));
    const double a = glm::dot(m[0], m[2]), b = glm::dot(m[1], m[2]);
    const double c = glm::dot(m[2], m[2]);
    return kLeanWeight * (a * a + b * b) / (c * c);
  }
  double addLean(const Steps& e, Steps& gradient) const {
    constexpr double kStep = 1e-5;
    for (std::size_t k = 0; k < e.size(); ++k) {
      Steps up = e, down = e;
      up[k] += kStep;
      down[k] -= kStep;
      gradient[k] += (lean(up) - lean(down)) / (2 * kStep);
    }
    return lean(e);
  }

  // The gradient of what `push_` is the slope of.
  void pull(const glm::dmat3& step, double scale, const MassSlope& mass, Steps& gradient) const {
    const glm::dmat3 back = glm::inverse(step);  // d log det = tr(back dE)
    double sum = 0;
    const double m00 = step[0][0], m01 = step[1][0], m02 = step[2][0];
    const double m10 = step[0][1], m11 = step[1][1], m12 = step[2][1];
    const double m20 = step[0][2], m21 = step[1][2], m22 = step[2][2];
    double b00 = 0, b01 = 0, b02 = 0, b10 = 0, b11 = 0, b12 = 0, b20 = 0, b21 = 0;
    const double *xs = x_.data(), *ys = y_.data(), *zs = z_.data();
    const double *weights = weight_.data(), *pushes = push_.data();
    const int count = static_cast<int>(count_);
    // With k = push weight density: sums of k, and of k times what dE does to log(t_z / |t|^4).
#pragma omp simd reduction(+ : sum, b00, b01, b02, b10, b11, b12, b20, b21)
    for (int i = 0; i < count; ++i) {
      const double x = xs[i], y = ys[i], z = zs[i];
      const double tx = m00 * x + m01 * y + m02 * z;
      const double ty = m10 * x + m11 * y + m12 * z;
      const double tz = m20 * x + m21 * y + m22 * z;
      const double inverse_q = 1 / (tx * tx + ty * ty + tz * tz);
      const double slope = tz > 0 ? scale * inverse_q * inverse_q * weights[i] : 0;  // in t_z
      const double pushed = pushes[i] * slope, k = pushed * tz, four = 4 * k * inverse_q;
      sum += k;
      b00 -= four * tx * x;
      b01 -= four * tx * y;
      b02 -= four * tx * z;
      b10 -= four * ty * x;
      b11 -= four * ty * y;
      b12 -= four * ty * z;
      const double along = pushed - four * tz;
      b20 += along * x;
      b21 += along * y;
    }
    // The mass's own slope, by d(M^-1) = dE start: chain through the columns of start.
    const auto by_mass = [&](int row, int column) {
      double slope = 0;
      for (int k = 0; k < 3; ++k) slope += mass.by_inverse[k][row] * start_[k][column];
      return slope / mass.share;
    };
    const auto total = [&](double b, int row, int column) {
      return b + sum * (back[row][column] - by_mass(row, column));
    };
    gradient = {total(b00, 0, 0), total(b01, 0, 1) + total(b10, 1, 0),
                total(b11, 1, 1), total(b02, 0, 2),
                total(b12, 1, 2), total(b20, 2, 0),
                total(b21, 2, 1)};
  }

  const HalfSpaces* halves_;
  glm::dmat3 start_;
  std::size_t count_;
  std::vector<double> x_, y_, z_, weight_, wanted_;
  mutable std::vector<double> difference_, push_;
};

}  // namespace

double anisotropicError(const AnisotropicSamples& samples, const glm::dmat3& inverse) {
  return LobeProblem(samples, nullptr, inverse).absoluteDifference();
}

glm::dmat3 fitAnisotropicLobe(const AnisotropicView& view, std::span<const glm::dmat3> starts) {
  const AnisotropicSamples samples = makeAnisotropicSamples(view, starts.front());
  const HalfSpaces halves(samples);
  const auto valueOf = [&](const glm::dmat3& start) {
    Steps unused;
    return LobeProblem(samples, &halves, start)(Steps{}, unused);
  };
  const glm::dmat3* rival = nullptr;
  double rival_value = std::numeric_limits<double>::infinity();
  for (const glm::dmat3& start : starts.subspan(1)) {
    const double value = valueOf(start);
    if (value >= rival_value) continue;
    rival_value = value;
    rival = &start;
  }
  glm::dmat3 best = starts.front();
  double least = std::numeric_limits<double>::infinity();
  for (const glm::dmat3* start : {&starts.front(), rival}) {
    if (start == nullptr) continue;
    const LobeProblem problem(samples, &halves, *start);
    const Minimum<7> found = minimize<7>(problem, Steps{}, kAnisotropicLimits);
    if (found.value >= least) continue;
    least = found.value;
    best = problem.inverse(found.at);
  }
  return best;
}

}  // namespace glintmark
