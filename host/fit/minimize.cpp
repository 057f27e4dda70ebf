#include "host/fit/minimize.h"

#include <ceres/gradient_problem.h>
#include <ceres/gradient_problem_solver.h>

#include <cmath>
#include <vector>

namespace glintmark {
namespace {

// No step of a line search may be this many times longer than the one before it: farther lie other
// minima, worse ones. Ceres' own limit is 10.
constexpr double kStepGrowth = 2;
// Only the gain in value decides.
constexpr double kNoTolerance = 1e-14;

// The function in variables that are measured in `unit`.
class ScaledFunction : public ceres::FirstOrderFunction {
 public:
  ScaledFunction(const Differentiable& function, std::size_t count, double unit)
      : function_(function), count_(count), unit_(unit) {}

  int NumParameters() const override { return static_cast<int>(count_); }

  bool Evaluate(const double* scaled, double* value, double* gradient) const override {
    std::vector<double> at(scaled, scaled + count_);
    for (double& x : at) x *= unit_;
    const std::span<double> by_x(gradient, gradient == nullptr ? 0 : count_);
    *value = function_(at, by_x);
    for (double& slope : by_x) slope *= unit_;
    return std::isfinite(*value);
  }

 private:
  const Differentiable& function_;
  std::size_t count_;
  double unit_;
};

}  // namespace

double minimizeInPlace(const Differentiable& function, std::span<double> at,
                       const MinimizeLimits& limits) {
  ceres::GradientProblemSolver::Options options;
  options.line_search_direction_type = ceres::BFGS;
  options.max_line_search_step_expansion = kStepGrowth;
  options.max_num_iterations = limits.iterations;
  options.function_tolerance = limits.least_gain;
  options.gradient_tolerance = kNoTolerance;
  options.parameter_tolerance = kNoTolerance;
  options.logging_type = ceres::SILENT;

  const std::vector<double> start(at.begin(), at.end());
  std::vector<double> scaled = start;
  for (double& x : scaled) x /= limits.unit;
  const ceres::GradientProblem problem(new ScaledFunction(function, at.size(), limits.unit));
  ceres::GradientProblemSolver::Summary summary;
  ceres::Solve(options, problem, scaled.data(), &summary);

  for (std::size_t i = 0; i < at.size(); ++i) at[i] = scaled[i] * limits.unit;
  const double first = function(start, {}), last = function(at, {});
  if (last <= first) return last;
  std::ranges::copy(start, at.begin());
  return first;
}

}  // namespace glintmark
