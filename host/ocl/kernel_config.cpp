#include "host/ocl/kernel_config.h"

#include <fmt/format.h>

#include <array>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr int kMaxKa = 64;

// In the order of enum Plane.
constexpr std::array<const char*, kPlaneCount> kPlaneNames = {
    "PIXEL", "U_INT", "V_INT", "U_FRAC", "V_FRAC", "DUDX",
    "DVDX",  "DUDY",  "DVDY",  "FRAME0", "FRAME1", "DEPTH"};

void validate(const KernelConfig& config) {
  const int w = config.width;
  if (w != 1 && w != 4 && w != 8 && w != 16)
    throw Error(fmt::format("kernel width {} is not one of 1, 4, 8 and 16", w));
  if (config.ka < 1 || config.ka > kMaxKa)
    throw Error(fmt::format("ka {} is out of range; it must be 1 to {}", config.ka, kMaxKa));
  if (config.method != GlintMethod::kZk16 && config.method != GlintMethod::kExact)
    throw Error(fmt::format("glint method {} is unknown; it must be 0 (zk16) or 1 (exact)",
                            static_cast<int>(config.method)));
}

}  // namespace

std::string buildOptions(const KernelConfig& config) {
  validate(config);
  std::string options = fmt::format(
      "-D WIDTH={} -D GLINT={:d} -D GROOVE={:d} -D GLINT_COLOUR={:d} -D SIZE_VARIATION={:d} "
      "-D LIGHT_CONE={:d} -D DIFFUSE={:d} -D COUNT_CELLS={:d} -D GLINT_METHOD={} -D KA={}",
      config.width, config.glint, config.groove, config.glint_colour, config.size_variation,
      config.light_cone, config.diffuse, config.count_cells, static_cast<int>(config.method),
      config.ka);
  for (std::size_t i = 0; i < kPlaneCount; ++i) {
    const Plane plane = static_cast<Plane>(i);
    if (config.planes.has(plane))
      options += fmt::format(" -D PLANE_{}={}", kPlaneNames[i], config.planes.slot(plane));
  }
  return options;
}

}  // namespace glintmark
