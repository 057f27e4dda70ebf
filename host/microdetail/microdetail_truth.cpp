#include "host/microdetail/microdetail_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/microdetail/microdetail_types.h"
#include "host/ocl/upload.h"
#include "host/reference/beckmann.h"

namespace glintmark {
namespace {

constexpr double kDetailsPerLaunch = 2e7;
constexpr std::size_t kTruthGroup = 4;  // work-items: pixels are long work
constexpr int kWheelColours = 768;

glm::dvec2 both(const float2& v) {
  return {v.x, v.y};
}

// Saturated hues, as many as steps, their mean white.
std::vector<float4> colourWheel() {
  std::vector<float4> colours;
  for (int i = 0; i < kWheelColours; ++i) {
    const double hue = (i + 0.5) / kWheelColours;
    // Distance around the wheel from each primary: full within a sixth, none beyond a third.
    const auto channel = [&](double primary) {
      const double distance = std::abs(hue - primary - std::round(hue - primary));
      return static_cast<float>(2 * std::clamp(2 - 6 * distance, 0.0, 1.0));
    };
    colours.push_back({channel(0), channel(1.0 / 3), channel(2.0 / 3), 0});
  }
  return colours;
}

std::vector<float4> coloursOf(const MicrodetailSurface& surface) {
  const GlintMaterial& glints = surface.material.glints;
  if (!surface.coloured) return {{1, 1, 1, 0}};
  if (glints.palette_count == 0) return colourWheel();
  return {glints.palette, glints.palette + glints.palette_count};
}

// The lattice as the filter sees it.
PixelLattice seenLattice(const PixelLattice& lattice, const MicrodetailSurface& surface) {
  return grown(lattice, 1 / double{surface.material.glints.density});
}

MicrodetailField fieldOf(const MicrodetailSurface& surface, const DetailCounts& counts,
                         const DetailSizes& sizes, std::size_t taps, std::size_t colours) {
  const glm::dvec2 alpha_l = both(surface.material.glints.alpha_l);
  const glm::dvec2 alpha_m =
      reference::mesoRoughness(both(surface.material.surface.alpha_g), alpha_l);
  MicrodetailField field{};
  field.alpha_m = {static_cast<float>(alpha_m.x), static_cast<float>(alpha_m.y)};
  field.per_alpha_l = {static_cast<float>(1 / alpha_l.x), static_cast<float>(1 / alpha_l.y)};
  field.cell_level = counts.cell_level;
  field.seed = surface.seed;
  field.tap_count = static_cast<uint>(taps);
  field.size_count = static_cast<uint>(sizes.sizes.size());
  field.colour_count = static_cast<uint>(colours);
  return field;
}

}  // namespace

double detailsPerPixel(const PixelLattice& lattice, const MicrodetailSurface& surface,
                       PixelFilter filter) {
  const PixelLattice seen = seenLattice(lattice, surface);
  const DetailSizes sizes = detailSizes(surface.material.glints.size_variation);
  const double density = surface.material.glints.density * sizes.number_factor;
  const double cell = std::exp2(detailCounts(density, surface.law).cell_level);
  const double scale = filter == PixelFilter::kTent ? 2 : 1;
  return density * (scale * glm::length(seen.edge_x) + cell) *
         (scale * glm::length(seen.edge_y) + cell);
}

MicrodetailTruth::MicrodetailTruth(Device& device, ProgramCache& cache, int lanes)
    : device_(device), cache_(cache), lanes_(lanes) {}

MicrodetailRatios MicrodetailTruth::place(const PixelLattice& lattice,
                                          const MicrodetailSurface& surface,
                                          const LightSlopes& light, PixelFilter filter,
                                          const Progress& progress) {
  const double density = surface.material.glints.density;
  const DetailSizes sizes = detailSizes(surface.material.glints.size_variation);
  const DetailCounts counts = detailCounts(density * sizes.number_factor, surface.law);
  const std::vector<float4> colours = coloursOf(surface);
  const PixelLattice seen = seenLattice(lattice, surface);
  const std::size_t pixels = lattice.size(), stride = pixelStride(lattice);
  const auto buffer = [&](const auto& items, const char* what) {
    return upload(device_, items, BufferPurpose::kMicrodetails, what);
  };
  const std::vector field = {fieldOf(surface, counts, sizes, light.taps.size(), colours.size())};
  Buffer sums(device_, MD_SUM_PLANES * stride * 4, BufferPurpose::kMicrodetails,
              "sums of microdetails");
  std::vector<KernelArg> arguments = {buffer(pixelWords(seen, stride), "pixels of a lattice"),
                                      buffer(field, "a field of microdetails"),
                                      buffer(counts.table, "counts of microdetails"),
                                      buffer(light.taps, "half vectors of a light"),
                                      buffer(sizes.sizes, "sizes of microdetails"),
                                      buffer(colours, "colours of microdetails"),
                                      sums,
                                      static_cast<std::uint32_t>(stride),
                                      std::uint32_t{0},
                                      std::uint32_t{0}};
  const bool marked = sizes.sizes.size() > 1 || surface.coloured;
  Kernel kernel = cache_
                      .getWithOptions("microdetail/place_details.cl",
                                      fmt::format("-D WIDTH={} -D TENT={} -D MARKED={:d}", lanes_,
                                                  static_cast<int>(filter), marked))
                      .kernel("placeDetails");
  const double each = detailsPerPixel(lattice, surface, filter);
  const auto batch = static_cast<std::size_t>(
      std::clamp(kDetailsPerLaunch / each, 1.0, static_cast<double>(pixels)));
  for (std::size_t first = 0; first < pixels; first += batch) {
    if (progress) progress(first, pixels);
    const std::size_t count = std::min(batch, pixels - first);
    arguments[arguments.size() - 2] = static_cast<std::uint32_t>(first);
    arguments[arguments.size() - 1] = static_cast<std::uint32_t>(count);
    kernel.launch(arguments, count, kTruthGroup);
  }
  std::vector<float> words(MD_SUM_PLANES * stride);
  sums.read(words.data(), words.size() * 4);
  const double expected = density * seen.area() * light.probability;
  const auto planes = [&](std::size_t plane) {
    std::vector<glm::vec3> values;
    for (std::size_t i = 0; i < pixels; ++i)
      values.push_back(glm::vec3(words[plane * stride + i], words[(plane + 1) * stride + i],
                                 words[(plane + 2) * stride + i]) /
                       static_cast<float>(expected));
    return values;
  };
  return {planes(MD_LOBES), planes(MD_REFLECTING)};
}

}  // namespace glintmark
