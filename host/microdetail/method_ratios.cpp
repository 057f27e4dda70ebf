#include "host/microdetail/method_ratios.h"

#include "host/ocl/upload.h"

namespace glintmark {

namespace {
constexpr std::size_t kGroup = 16;  // work-items
}

std::vector<glm::vec3> methodRatios(Device& device, ProgramCache& cache, const KernelConfig& config,
                                    const PixelLattice& lattice, const MaterialParams& material,
                                    const glm::dvec2& half_slope) {
  const std::size_t pixels = lattice.size(), stride = pixelStride(lattice);
  Buffer ratios(device, 3 * stride * 4, BufferPurpose::kMicrodetails, "ratios of a glint method");
  const KernelArg arguments[] = {
      upload(device, pixelWords(lattice, stride), BufferPurpose::kMicrodetails,
             "pixels of a lattice"),
      upload(device, std::vector{material}, BufferPurpose::kMicrodetails, "a material"),
      ratios,
      static_cast<float>(half_slope.x),
      static_cast<float>(half_slope.y),
      static_cast<std::uint32_t>(stride)};
  cache.get("microdetail/method_ratios.cl", config)
      .kernel("methodRatios")
      .launch(arguments, stride / static_cast<std::size_t>(config.width), kGroup);
  std::vector<float> words(3 * stride);
  ratios.read(words.data(), words.size() * 4);
  std::vector<glm::vec3> values;
  for (std::size_t i = 0; i < pixels; ++i)
    values.emplace_back(words[i], words[stride + i], words[2 * stride + i]);
  return values;
}

}  // namespace glintmark
