#include "host/scene/noise.h"

namespace glintmark {
namespace {

/// Integer finaliser: every input bit reaches every output bit.
std::uint32_t mixBits(std::uint32_t x) {
  x ^= x >> 16;
  x *= 0x21F0AAADu;
  x ^= x >> 15;
  x *= 0x735A2D97u;
  x ^= x >> 15;
  return x;
}

/// Dot product of a lattice point's gradient, uniform in [-1, 1]^2, with the offset from it.
double cornerValue(const glm::ivec2& corner, const glm::dvec2& offset, std::uint32_t seed) {
  const auto x = static_cast<std::uint32_t>(corner.x), y = static_cast<std::uint32_t>(corner.y);
  const std::uint32_t bits = mixBits(x + mixBits(y + mixBits(seed)));
  const double gx = (bits & 0xFFFFu) * 0x1p-15 - 1, gy = (bits >> 16) * 0x1p-15 - 1;
  return gx * offset.x + gy * offset.y;
}

/// Blend with zero first and second derivative at both ends.
double quinticBlend(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

}  // namespace

double gradientNoise(const glm::dvec2& point, std::uint32_t seed) {
  const glm::dvec2 cell = glm::floor(point);
  const glm::dvec2 offset = point - cell;
  const glm::ivec2 corner(cell);
  const double v00 = cornerValue(corner, offset, seed);
  const double v10 = cornerValue(corner + glm::ivec2(1, 0), offset - glm::dvec2(1, 0), seed);
  const double v01 = cornerValue(corner + glm::ivec2(0, 1), offset - glm::dvec2(0, 1), seed);
  const double v11 = cornerValue(corner + glm::ivec2(1, 1), offset - glm::dvec2(1, 1), seed);
  const double bx = quinticBlend(offset.x), by = quinticBlend(offset.y);
  return glm::mix(glm::mix(v00, v10, bx), glm::mix(v01, v11, bx), by);
}

double fractalNoise(const glm::dvec2& point, int octaves, double gain, std::uint32_t seed) {
  double sum = 0, height = 1;
  glm::dvec2 position = point;
  for (int octave = 0; octave < octaves; ++octave) {
    sum += height * gradientNoise(position, seed + static_cast<std::uint32_t>(octave));
    // Turned a little each time, so that the lattices never line up.
    position = glm::dvec2(1.6 * position.x - 1.2 * position.y, 1.2 * position.x + 1.6 * position.y);
    height *= gain;
  }
  return sum;
}

}  // namespace glintmark
