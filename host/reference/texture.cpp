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

}  // namespace

ProbeLine footprintProbes(int width, int height, int level_count, const glm::dvec2& uv,
                          const UvDerivatives& derivatives, int most_probes) {
  const glm::dvec2 size(width, height);
  const glm::dvec2 dx = derivatives.dx * size, dy = derivatives.dy * size;
  // The major axis is the longest image of a unit vector (cos t, sin t) of the screen: the length
  // of cos t dx + sin t dy is greatest where tan 2t = 2 dx.dy / (|dx|^2 - |dy|^2).
  const double t = 0.5 * std::atan2(2 * glm::dot(dx, dy), glm::dot(dx, dx) - glm::dot(dy, dy));
  const glm::dvec2 major = std::cos(t) * dx + std::sin(t) * dy;
  const glm::dvec2 minor = std::cos(t) * dy - std::sin(t) * dx;
  const double length = glm::length(major);
  const double probe = std::max({glm::length(minor), length / most_probes, kProbeTexels});

  ProbeLine line;
  line.ratio = length / probe;
  line.count = std::clamp(static_cast<int>(std::ceil(line.ratio - 0.01)), 1, most_probes);
  line.level = std::clamp(std::log2(probe / kProbeTexels), 0.0, level_count - 1.0);
  line.step = major / size / static_cast<double>(line.count);
  line.first = uv - line.step * (0.5 * (line.count - 1));
  return line;
}

std::vector<double> filterTexture(const std::vector<TextureLevel>& levels, const ProbeLine& line,
                                  bool repeat) {
  std::vector<double> sum(levels.front().texels.front().size(), 0.0);
  const auto fine = static_cast<std::size_t>(line.level);
  const std::size_t coarse = std::min(fine + 1, levels.size() - 1);
  const double blend = line.level - static_cast<double>(fine);
  for (int i = 0; i < line.count; ++i) {
    glm::dvec2 uv = line.first + line.step * static_cast<double>(i);
    uv -= glm::floor(uv);
    addBilinear(levels[fine], uv, repeat, (1 - blend) / line.count, sum);
    addBilinear(levels[coarse], uv, repeat, blend / line.count, sum);
  }
  return sum;
}

}  // namespace glintmark::reference
