// Textures and footprints for the fetch of kernels/normals/texture.clh, on the device and for the
// reference.
#pragma once
#include <cstdint>
#include <vector>

#include "host/core/shared_types.h"
#include "host/harness/kernel_bench.h"
#include "host/reference/texture.h"

namespace glintmark {

/// A mip chain as the kernels read it and as the reference does.
struct TestTexture {
  MipTexture header{};
  std::vector<float4> texels;
  std::vector<reference::TextureLevel> levels;
};

/// Random values in [-1, 1), `texel_size` float4 per texel, every level on its own.
TestTexture randomTexture(int width, int height, int texel_size, std::uint32_t seed);

/// One pixel: centre in 2^-32 uv, derivatives in uv per pixel.
struct TexturePixel {
  std::uint32_t u = 0, v = 0;
  float dudx = 0, dvdx = 0, dudy = 0, dvdy = 0;
};

/// Footprints of all sizes, shapes and directions.
std::vector<TexturePixel> randomFootprints(std::size_t n, std::uint32_t seed);

struct FetchedTexel {
  std::vector<float> values;
  int count = 0, rows = 0;  // probes of a row, and rows
  float level = 0;
  float true_spread = 0;  // share of the finest texels' variance that lies under the footprint
};

/// The device's fetch at `width` lanes.
std::vector<FetchedTexel> fetchPixels(KernelBench& bench, const TestTexture& texture,
                                      int texel_size, const std::vector<TexturePixel>& pixels,
                                      const reference::ProbeLimits& most, bool repeat, int width);

}  // namespace glintmark
