#include "host/microdetail/method_ratios.h"

#include "host/core/glint_grids.h"
#include "host/microdetail/microdetail_types.h"
#include "host/ocl/upload.h"

namespace glintmark {
namespace {

constexpr std::size_t kRatioGroup = 16;  // work-items

// The planes of several lattices behind each other.
std::vector<std::uint32_t> allWords(std::span<const PixelLattice> lattices, std::size_t stride) {
  std::vector<std::uint32_t> words(MD_PIXEL_PLANES * stride);
  std::size_t first = 0;
  for (const PixelLattice& lattice : lattices) {
    const std::size_t own = pixelStride(lattice);
    const std::vector<std::uint32_t> some = pixelWords(lattice, own);
    for (std::size_t plane = 0; plane < MD_PIXEL_PLANES; ++plane)
      for (std::size_t i = 0; i < own; ++i)
        words[plane * stride + first + i] = some[plane * own + i];
    first += own;
  }
  return words;
}

}  // namespace

std::vector<std::vector<glm::vec3>> methodRatios(Device& device, ProgramCache& cache,
                                                 const KernelConfig& config,
                                                 std::span<const PixelLattice> lattices,
                                                 const MaterialParams& material,
                                                 const glm::dvec2& half_slope,
                                                 const std::optional<Buffer>& table) {
  std::size_t stride = 0;
  for (const PixelLattice& lattice : lattices) stride += pixelStride(lattice);
  Buffer ratios(device, 3 * stride * 4, BufferPurpose::kMicrodetails, "ratios of a glint method");
  std::vector<KernelArg> arguments = {upload(device, allWords(lattices, stride),
                                             BufferPurpose::kMicrodetails, "pixels of lattices"),
                                      upload(device, std::vector{withGlintGrids(material)},
                                             BufferPurpose::kMicrodetails, "a material"),
                                      ratios,
                                      static_cast<float>(half_slope.x),
                                      static_cast<float>(half_slope.y),
                                      static_cast<std::uint32_t>(stride)};
  if (table) arguments.push_back(*table);
  cache.get("microdetail/method_ratios.cl", config)
      .kernel("methodRatios")
      .launch(arguments, stride / static_cast<std::size_t>(config.width), kRatioGroup);
  std::vector<float> words(3 * stride);
  ratios.read(words.data(), words.size() * 4);
  std::vector<std::vector<glm::vec3>> values;
  std::size_t first = 0;
  for (const PixelLattice& lattice : lattices) {
    values.emplace_back();
    for (std::size_t i = first; i < first + lattice.size(); ++i)
      values.back().emplace_back(words[i], words[stride + i], words[2 * stride + i]);
    first += pixelStride(lattice);
  }
  return values;
}

}  // namespace glintmark
