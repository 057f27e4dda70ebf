#include "host/ocl/kernel_config.h"

#include <fmt/format.h>

#include <array>

#include "host/ocl/switches.h"

namespace glintmark {
namespace {

// In the order of enum Plane.
constexpr std::array<const char*, kPlaneCount> kPlaneNames = {
    "PIXEL", "U_INT", "V_INT", "U_FRAC", "V_FRAC", "DUDX",
    "DVDX",  "DUDY",  "DVDY",  "FRAME0", "FRAME1", "DEPTH"};

}  // namespace

std::string buildOptions(const KernelConfig& config) {
  requireAllowed(config);
  std::string options;
  for (const Switch& row : allSwitches())
    options += fmt::format("{}-D {}={}", options.empty() ? "" : " ", row.macro,
                           row.textOf(row.of(config)));
  for (std::size_t i = 0; i < kPlaneCount; ++i) {
    const Plane plane = static_cast<Plane>(i);
    if (config.planes.has(plane))
      options += fmt::format(" -D PLANE_{}={}", kPlaneNames[i], config.planes.slot(plane));
  }
  return options;
}

}  // namespace glintmark
