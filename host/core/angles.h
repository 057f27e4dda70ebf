// Numbers of angles.
#pragma once
#include <numbers>

namespace glintmark {

inline constexpr double kPi = std::numbers::pi;
inline constexpr double kDegree = kPi / 180;  // [rad]

}  // namespace glintmark
