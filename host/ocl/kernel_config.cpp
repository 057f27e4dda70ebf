#include "host/ocl/kernel_config.h"

#include <fmt/format.h>

#include <array>

#include "host/core/error.h"
#include "host/core/shared_types.h"

namespace glintmark {
namespace {

constexpr int kMaxKa = 64;
constexpr int kMinBinomialTerms = 2, kMaxBinomialTerms = 64;
constexpr int kMaxLobes = 8;
constexpr int kMaxAnisotropy = 16;

// In the order of enum Plane.
constexpr std::array<const char*, kPlaneCount> kPlaneNames = {
    "PIXEL", "U_INT", "V_INT", "U_FRAC", "V_FRAC", "DUDX",
    "DVDX",  "DUDY",  "DVDY",  "FRAME0", "FRAME1", "DEPTH"};

void requireRange(const char* what, int value, int most) {
  if (value < 1 || value > most)
    throw Error(fmt::format("{} {} is out of range; it must be 1 to {}", what, value, most));
}

void validate(const KernelConfig& config) {
  const int w = config.width;
  if (w != 1 && w != 4 && w != 8 && w != 16)
    throw Error(fmt::format("kernel width {} is not one of 1, 4, 8 and 16", w));
  requireRange("ka", config.ka, kMaxKa);
  requireRange("grid count", config.grids, 2);
  if (config.binomial_terms < kMinBinomialTerms || config.binomial_terms > kMaxBinomialTerms)
    throw Error(fmt::format("binomial term count {} is out of range; it must be {} to {}",
                            config.binomial_terms, kMinBinomialTerms, kMaxBinomialTerms));
  requireRange("lobe count", config.lobes, kMaxLobes);
  requireRange("anisotropy", config.anisotropy, kMaxAnisotropy);
  if (config.light_vertices < 3 || config.light_vertices > static_cast<int>(GM_MAX_LIGHT_VERTICES))
    throw Error(fmt::format("light vertex count {} is out of range; it must be 3 to {}",
                            config.light_vertices, GM_MAX_LIGHT_VERTICES));
  if (config.method != GlintMethod::kZk16 && config.method != GlintMethod::kExact)
    throw Error(fmt::format("glint method {} is unknown; it must be 0 (zk16) or 1 (exact)",
                            static_cast<int>(config.method)));
}

}  // namespace

std::string buildOptions(const KernelConfig& config) {
  validate(config);
  std::string options = fmt::format(
      "-D WIDTH={} -D ALL_MATERIALS={:d} -D GLINT={:d} -D GROOVE={:d} -D GLINT_COLOUR={:d} -D "
      "SIZE_VARIATION={:d} "
      "-D CONE_LIGHTS={:d} -D LIGHT_CONE={:d} -D DIFFUSE={:d} -D COUNT_CELLS={:d} -D "
      "GLINT_METHOD={} -D KA={} "
      "-D GGX={:d}",
      config.width, config.all_materials, config.glint, config.groove, config.glint_colour,
      config.size_variation, config.cone_lights, config.light_cone, config.diffuse,
      config.count_cells, static_cast<int>(config.method), config.ka, config.ggx);
  options += fmt::format(
      " -D NORMAL_MAP={:d} -D NORMAL_METHOD={} -D LOBES={} -D ANISOTROPY={} -D HALF_TEXELS={:d} "
      "-D LTC={:d} -D LTC_METHOD={} -D LIGHT_VERTICES={} -D CLIPLESS={:d} -D LIGHT_TEXTURE={:d} -D "
      "MULTISCATTER={} "
      "-D LOBE_MASKING={:d} -D METAL_COMPENSATION={:d}",
      config.normal_map, static_cast<int>(config.normal_method), config.lobes, config.anisotropy,
      config.half_texels, config.ltc, static_cast<int>(config.ltc_method), config.light_vertices,
      config.clipless, config.light_texture, static_cast<int>(config.multiscatter),
      config.lobe_masking, config.metal_compensation);
  options += fmt::format(
      " -D GRIDS={} -D BINOMIAL={} -D BINOMIAL_TERMS={} -D MATHS={} -D EDGES={} -D LTC_HALF={:d}",
      config.grids, static_cast<int>(config.binomial), config.binomial_terms,
      static_cast<int>(config.maths), static_cast<int>(config.edges), config.ltc_half);
  for (std::size_t i = 0; i < kPlaneCount; ++i) {
    const Plane plane = static_cast<Plane>(i);
    if (config.planes.has(plane))
      options += fmt::format(" -D PLANE_{}={}", kPlaneNames[i], config.planes.slot(plane));
  }
  return options;
}

}  // namespace glintmark
