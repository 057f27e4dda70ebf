#include "host/reference/curved_lobe.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/reference/beckmann.h"

namespace glintmark::reference {
namespace {

constexpr double kPixelVariance = 0.5 / std::numbers::pi;
constexpr double kStep_px = 1e-5;  // of differences

// A half vector along the axes of a pixel's frame.
struct LocalHalf {
  double x, y, z;
};

// `frame` turned with its normal, and no more than that.
ShadingFrame carriedFrame(const ShadingFrame& frame, const glm::dvec3& normal) {
  const glm::dvec3 sum = frame.normal + normal;
  const double share = 1 / (1 + glm::dot(frame.normal, normal));
  const auto carried = [&](const glm::dvec3& t) { return t - glm::dot(t, normal) * share * sum; };
  return {carried(frame.tangent), carried(frame.bitangent), normal};
}

LocalHalf halfAt(const CurvedPixel& pixel, const glm::dvec3& light, double right, double down) {
  const glm::dvec3 normal =
      glm::normalize(pixel.frame.normal + right * pixel.normal_dx + down * pixel.normal_dy);
  const glm::dvec3 view = -glm::normalize(pixel.ray + right * pixel.ray_dx + down * pixel.ray_dy);
  const glm::dvec3 half = glm::normalize(light + view);
  const ShadingFrame frame = carriedFrame(pixel.frame, normal);
  return {glm::dot(half, frame.tangent), glm::dot(half, frame.bitangent), glm::dot(half, normal)};
}

glm::dvec2 filtered(const CurvedPixel& pixel, const glm::dvec3& light, CurvatureFilter filter,
                    double right, double down) {
  const LocalHalf h = halfAt(pixel, light, right, down);
  return filter == CurvatureFilter::kSlopes ? glm::dvec2(h.x / h.z, h.y / h.z)
                                            : glm::dvec2(h.x, h.y);
}

// Steps per pixel by central differences.
HalfSteps stepsOf(const CurvedPixel& pixel, const glm::dvec3& light, CurvatureFilter filter) {
  const auto change = [&](double right, double down) {
    return (filtered(pixel, light, filter, right, down) -
            filtered(pixel, light, filter, -right, -down)) /
           (2 * kStep_px);
  };
  return {change(kStep_px, 0), change(0, kStep_px)};
}

// Twice the covariance.
glm::dmat2 kernelOf(const CurvedPixel& pixel, const glm::dvec3& light, CurvatureFilter filter) {
  const auto [a, b] = stepsOf(pixel, light, filter);
  const glm::dmat2 kernel =
      2 * kPixelVariance * (glm::outerProduct(a, a) + glm::outerProduct(b, b));
  const double trace = kernel[0][0] + kernel[1][1];
  return kernel * std::min(1.0, kMostWidening / std::max(trace, 1e-300));
}

glm::dmat2 diagonal(const glm::dvec2& d) {
  return {d.x, 0, 0, d.y};
}

double tangentialSq(const glm::dvec3& step, const glm::dvec3& normal) {
  const glm::dvec3 t = step - glm::dot(step, normal) * normal;
  return glm::dot(t, t);
}

// Smith's Lambda of slopes whose squared roughness is a matrix: by alpha times the tangent.
double lambdaOf(const glm::dvec3& w, const glm::dmat2& roughness, Ndf ndf) {
  const glm::dvec2 flat(w);
  const double alpha_sin_sq = std::max(glm::dot(flat, roughness * flat), 0.0);
  if (ndf == Ndf::kGgx) return 0.5 * (std::sqrt(1 + alpha_sin_sq / (w.z * w.z)) - 1);
  const glm::dvec3 alike = glm::normalize(glm::dvec3(std::sqrt(alpha_sin_sq), 0, w.z));
  return smithLambda(alike, glm::dvec2(1));
}

double densityOf(const glm::dvec2& slope, const glm::dmat2& roughness, Ndf ndf) {
  const double exponent = glm::dot(slope, glm::inverse(roughness) * slope);
  const double peak = 1 / (std::numbers::pi * std::sqrt(glm::determinant(roughness)));
  return ndf == Ndf::kGgx ? peak / ((1 + exponent) * (1 + exponent)) : peak * std::exp(-exponent);
}

// Mean of exp(-x^2) / sqrt(pi) over a stretch of length `side` around `p`.
double stretchMean(double p, double side) {
  if (side < 1e-6) return std::exp(-p * p) / std::sqrt(std::numbers::pi);
  // Of the same sign, whose differences cancel least.
  const double low = std::abs(p) - 0.5 * side, high = std::abs(p) + 0.5 * side;
  return 0.5 * (std::erfc(low) - std::erfc(high)) / side;
}

}  // namespace

double rectangleDensity(const glm::dvec2& slope, const glm::dvec2& a, const glm::dvec2& b,
                        const glm::dvec2& alpha) {
  const glm::dvec2 p = slope / alpha, u = a / alpha, v = b / alpha;
  const glm::dmat2 squares = glm::outerProduct(u, u) + glm::outerProduct(v, v);
  const double turn = 0.5 * std::atan2(2 * squares[0][1], squares[0][0] - squares[1][1]);
  const glm::dvec2 first(std::cos(turn), std::sin(turn)), second(-first.y, first.x);
  const auto side = [&](const glm::dvec2& axis) {
    return std::sqrt(std::max(glm::dot(axis, squares * axis), 0.0));
  };
  return stretchMean(glm::dot(first, p), side(first)) *
         stretchMean(glm::dot(second, p), side(second)) / (alpha.x * alpha.y);
}

double parallelogramDensity(const glm::dvec2& slope, const glm::dvec2& a, const glm::dvec2& b,
                            const glm::dvec2& alpha, Ndf ndf, int samples_per_side) {
  const auto place = [&](int i) { return (i + 0.5) / samples_per_side - 0.5; };
  double sum = 0;
  for (int j = 0; j < samples_per_side; ++j)
    for (int i = 0; i < samples_per_side; ++i)
      sum += densityOf(slope + place(i) * a + place(j) * b, diagonal(alpha * alpha), ndf);
  return sum / (samples_per_side * samples_per_side);
}

HalfSteps projectedSteps(const CurvedPixel& pixel, const glm::dvec3& light) {
  HalfSteps steps = stepsOf(pixel, light, CurvatureFilter::kFootprint);
  const double widening =
      (glm::dot(steps.right, steps.right) + glm::dot(steps.down, steps.down)) / 6;
  const double scale = std::sqrt(std::min(1.0, kMostWidening / std::max(widening, 1e-300)));
  return {scale * steps.right, scale * steps.down};
}

glm::dmat2 widenedRoughness(const CurvedPixel& pixel, const glm::dvec3& light,
                            const glm::dvec2& alpha, CurvatureFilter filter) {
  const glm::dvec2 base = alpha * alpha;
  if (filter == CurvatureFilter::kNormals) {
    const double steps = tangentialSq(pixel.normal_dx, pixel.frame.normal) +
                         tangentialSq(pixel.normal_dy, pixel.frame.normal);
    const double widening = std::min(2 * kPixelVariance * steps, kMostWidening);
    return diagonal(glm::min(base + widening, glm::dvec2(1)));
  }
  const glm::dmat2 kernel = kernelOf(pixel, light, filter);
  if (filter == CurvatureFilter::kSlopes) return diagonal(base) + kernel;
  // There and back: 1 / projected = 1 / alpha^2 - 1.
  const glm::dmat2 projected = diagonal(base / glm::max(1.0 - base, glm::dvec2(1e-3)));
  return glm::inverse(glm::inverse(projected + kernel) + glm::dmat2(1));
}

double curvedLobe(const CurvedPixel& pixel, const glm::dvec3& light, const glm::dvec2& alpha,
                  CurvatureFilter filter, Ndf ndf) {
  const auto local = [&](const glm::dvec3& w) {
    return glm::dvec3(glm::dot(pixel.frame.tangent, w), glm::dot(pixel.frame.bitangent, w),
                      glm::dot(pixel.frame.normal, w));
  };
  const glm::dvec3 i = local(light), o = local(-glm::normalize(pixel.ray));
  if (i.z <= 0 || o.z <= 0) return 0;
  const bool box = filter == CurvatureFilter::kFootprint;
  const glm::dmat2 roughness =
      box ? diagonal(alpha * alpha) : widenedRoughness(pixel, light, alpha, filter);
  const glm::dvec3 m = glm::normalize(i + o);
  const glm::dvec2 slope = glm::dvec2(m) / m.z;
  const HalfSteps steps = projectedSteps(pixel, light);
  const double density = box ? rectangleDensity(slope, steps.right, steps.down, alpha)
                             : densityOf(slope, roughness, ndf);
  const double d = density / std::pow(m.z, 4);
  const double masking = 1 / (1 + lambdaOf(i, roughness, ndf) + lambdaOf(o, roughness, ndf));
  return d * masking / (4 * o.z);
}

}  // namespace glintmark::reference
