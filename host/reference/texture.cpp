#include "host/reference/texture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace glintmark::reference {
namespace {

// A box as wide as a texel and a tent twice as wide have, one after the other, the variance of a
// box sqrt(3) texels wide.
const double kProbeTexels = std::sqrt(3.0);

int wrapped(int i, int n, bool repeat) {
  return repeat ? ((i % n) + n) % n : std::clamp(i, 0, n - 1);
}

void addBilinear(const TextureLevel& level, const glm::dvec2& uv, bool repeat, double weight,
                 std::vector<double>& sum) {
  const double x = uv.x * level.width - 0.5, y = uv.y * level.height - 0.5;
  const int x0 = static_cast<int>(std::floor(x)), y0 = static_cast<int>(std::floor(y));
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i) {
      const double wx = i == 0 ? 1 - (x - x0) : x - x0, wy = j == 0 ? 1 - (y - y0) : y - y0;
      const std::size_t column = static_cast<std::size_t>(wrapped(x0 + i, level.width, repeat));
      const std::size_t row = static_cast<std::size_t>(wrapped(y0 + j, level.height, repeat));
      const auto& texel = level.texels[row * static_cast<std::size_t>(level.width) + column];
      for (std::size_t c = 0; c < sum.size(); ++c) sum[c] += weight * wx * wy * texel[c];
    }
}

// Product of edges over area up to which rows follow edges.
constexpr double kMostSlant = 1.5;

// Probes that cover `ratio` of their width; `margin` shrinks to how near that is to another count.
int coveringCount(double ratio, int most, double& margin) {
  const double x = ratio - 0.01;
  margin = std::min(margin, std::abs(x - std::round(x)));
  return std::clamp(static_cast<int>(std::ceil(x)), 1, most);
}

// The distance of `count` evenly spread points whose variance is that of a box of `length`: by
// their offsets' own mean square, in steps.
double matchingStep(double length, int count) {
  double mean_square = 0;
  for (int i = 0; i < count; ++i) mean_square += std::pow(i - 0.5 * (count - 1), 2) / count;
  return count == 1 ? 0 : length / std::sqrt(12 * mean_square);
}

// What points have to add to a probe for the variance of a box of `length`.
double restOf(double length, double probe) {
  return std::sqrt(std::max(length * length - probe * probe, 0.0));
}

}  // namespace

ProbeGrid footprintProbes(int width, int height, int level_count, const glm::dvec2& uv,
                          const UvDerivatives& derivatives, const ProbeLimits& most) {
  const glm::dvec2 size(width, height);
  const glm::dvec2 dx = derivatives.dx * size, dy = derivatives.dy * size;
  // The major axis is the longest image of a unit vector (cos t, sin t) of the screen: the length
  // of cos t dx + sin t dy is greatest where tan 2t = 2 dx.dy / (|dx|^2 - |dy|^2).
  const double t = 0.5 * std::atan2(2 * glm::dot(dx, dy), glm::dot(dx, dx) - glm::dot(dy, dy));
  const glm::dvec2 major = std::cos(t) * dx + std::sin(t) * dy;
  const glm::dvec2 minor = std::cos(t) * dy - std::sin(t) * dx;
  const double length = glm::length(major), breadth = glm::length(minor);
  // What rows may not be finer than.
  const int most_in_rows = std::min(most.count, 2 * most.rows * most.rows);
  const double bound =
      std::max(length * most.rows / most_in_rows, most.least_texels * kProbeTexels);
  const double row =
      most.rows == 1 ? breadth : std::max(breadth / most.rows, std::min(breadth, bound));
  const double probe = std::max({row, length / most.count, kProbeTexels});

  ProbeGrid grid;
  grid.level = std::clamp(std::log2(probe / kProbeTexels), 0.0, level_count - 1.0);
  grid.count = coveringCount(length / probe, most.count, grid.margin);
  grid.rows = coveringCount(breadth / probe, most.rows, grid.margin);
  const auto along = [&](const glm::dvec2& axis, double rest, int count) {
    return count == 1 ? glm::dvec2(0) : glm::normalize(axis) * matchingStep(rest, count);
  };
  const double long_rest = restOf(length, probe), short_rest = restOf(breadth, probe);
  grid.along = along(major, long_rest, grid.count);
  grid.across = along(minor, short_rest, grid.rows);
  if (grid.rows > 1) {
    const double slant = glm::length(dx) * glm::length(dy) / (length * breadth);
    grid.margin = std::min(grid.margin, std::abs(slant - kMostSlant));
    if (slant < kMostSlant) {
      const glm::dvec2 a = glm::normalize(major) * long_rest,
                       b = glm::normalize(minor) * short_rest;
      grid.count = coveringCount(glm::length(dx) / probe, most.count, grid.margin);
      grid.rows = coveringCount(glm::length(dy) / probe, most.count, grid.margin);
      grid.along = (std::cos(t) * a - std::sin(t) * b) * matchingStep(1, grid.count);
      grid.across = (std::sin(t) * a + std::cos(t) * b) * matchingStep(1, grid.rows);
    }
  }
  grid.along /= size;
  grid.across /= size;
  grid.first = uv - grid.along * (0.5 * (grid.count - 1)) - grid.across * (0.5 * (grid.rows - 1));
  return grid;
}

std::vector<double> filterTexture(const std::vector<TextureLevel>& levels, const ProbeGrid& grid,
                                  bool repeat) {
  std::vector<double> sum(levels.front().texels.front().size(), 0.0);
  const auto fine = static_cast<std::size_t>(grid.level);
  const std::size_t coarse = std::min(fine + 1, levels.size() - 1);
  const double blend = grid.level - static_cast<double>(fine);
  const double share = 1.0 / (grid.count * grid.rows);
  for (int j = 0; j < grid.rows; ++j)
    for (int i = 0; i < grid.count; ++i) {
      glm::dvec2 uv =
          grid.first + grid.along * static_cast<double>(i) + grid.across * static_cast<double>(j);
      uv -= glm::floor(uv);
      addBilinear(levels[fine], uv, repeat, (1 - blend) * share, sum);
      addBilinear(levels[coarse], uv, repeat, blend * share, sum);
    }
  return sum;
}

}  // namespace glintmark::reference
