// Deterministic smooth noise for procedural meshes: the same bits on every machine that rounds
// doubles as IEEE 754 says.
#pragma once
#include <cstdint>
#include <glm/glm.hpp>

namespace glintmark {

/// Gradient noise on the unit lattice, twice differentiable, inside [-1, 1], mean 0.
double gradientNoise(const glm::dvec2& point, std::uint32_t seed);

/// Sum of `octaves` noises; each has twice the frequency and `gain` times the height of the last.
double fractalNoise(const glm::dvec2& point, int octaves, double gain, std::uint32_t seed);

}  // namespace glintmark
