#include "host/ocl/kernel_config.h"

#include <fmt/format.h>

#include <array>

#include "host/ocl/switches.h"

namespace glintmark {
namespace {

// In the order of enum Plane.
constexpr std::array<const char*, kPlaneCount> kPlaneNames = {
    "PIXEL",  "U_INT",  "V_INT", "U_FRAC", "V_FRAC", "DUDX",   "DVDX",   "DUDY",   "DVDY",
    "FRAME0", "FRAME1", "DEPTH", "DNX_DX", "DNY_DX", "DNZ_DX", "DNX_DY", "DNY_DY", "DNZ_DY"};

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

std::string programOptions(const KernelConfig& config) {
  std::string options = buildOptions(config);
  if (!config.all_materials) return options;
  for (const Switch& row : allSwitches())
    if (row.bit != 0) options += fmt::format(" -D EFFECT_{}={}u", row.macro, row.bit);
  return options;
}

std::uint32_t effectBits(const KernelConfig& config) {
  std::uint32_t bits = 0;
  for (const Switch& row : allSwitches())
    if (row.of(config) != 0) bits |= row.bit;
  return bits;
}

}  // namespace glintmark
