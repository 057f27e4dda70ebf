#include "host/harness/texture_harness.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>

namespace glintmark {
namespace {

constexpr int kTextureRepeat = 0, kTextureClamp = 1;  // as in kernels/normals/texture.clh

}  // namespace

TestTexture randomTexture(int width, int height, int texel_size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> value(-1, 1);
  TestTexture texture;
  texture.header.width = static_cast<uint>(width);
  texture.header.height = static_cast<uint>(height);
  uint first = 0;
  for (int l = 0; l == 0 || std::max(width, height) >> l > 0; ++l) {
    reference::TextureLevel level{std::max(1, width >> l), std::max(1, height >> l), {}};
    texture.header.first[l] = first;
    texture.header.level_count = static_cast<uint>(l + 1);
    for (int i = 0; i < level.width * level.height; ++i, ++first) {
      std::vector<double> texel;
      for (int k = 0; k < texel_size; ++k) {
        const float4 quad = {value(random), value(random), value(random), value(random)};
        texture.texels.push_back(quad);
        texel.insert(texel.end(), {quad.x, quad.y, quad.z, quad.w});
      }
      level.texels.push_back(std::move(texel));
    }
    texture.levels.push_back(std::move(level));
  }
  return texture;
}

std::vector<TexturePixel> randomFootprints(std::size_t n, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0, 1);
  std::vector<TexturePixel> pixels(n);
  for (TexturePixel& p : pixels) {
    p.u = static_cast<std::uint32_t>(random());
    p.v = static_cast<std::uint32_t>(random());
    const float length = std::exp2(-12 + 13 * unit(random)),
                slimness = std::exp2(-6 * unit(random));
    const float a = 6.2831853f * unit(random), b = 6.2831853f * unit(random);
    // A rotation, a stretch, a rotation.
    const float c = std::cos(a), s = std::sin(a), x = std::cos(b), y = std::sin(b);
    p.dudx = length * (c * x - slimness * s * y);
    p.dvdx = length * (s * x + slimness * c * y);
    p.dudy = length * (-c * y - slimness * s * x);
    p.dvdy = length * (-s * y + slimness * c * x);
  }
  return pixels;
}

std::vector<FetchedTexel> fetchPixels(KernelBench& bench, const TestTexture& texture,
                                      int texel_size, const std::vector<TexturePixel>& pixels,
                                      const reference::ProbeLimits& most, bool repeat, int width) {
  const std::size_t n = paddedCount(pixels.size());
  std::vector<std::uint32_t> planes(6 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const TexturePixel& p = pixels[std::min(i, pixels.size() - 1)];
    const float derivatives[] = {p.dudx, p.dvdx, p.dudy, p.dvdy};
    planes[i] = p.u;
    planes[n + i] = p.v;
    for (std::size_t d = 0; d < 4; ++d)
      planes[(2 + d) * n + i] = std::bit_cast<std::uint32_t>(derivatives[d]);
  }
  const std::size_t components = 4 * static_cast<std::size_t>(texel_size);
  std::vector<float> words((components + 4) * n);
  Buffer out(bench.device, words.size() * 4, BufferPurpose::kProbe);
  const std::vector<KernelArg> args = {probeData(bench, std::vector{texture.header}),
                                       probeData(bench, texture.texels),
                                       probeData(bench, planes),
                                       out,
                                       static_cast<std::uint32_t>(n),
                                       most.count,
                                       most.rows,
                                       static_cast<float>(most.least_texels),
                                       repeat ? kTextureRepeat : kTextureClamp};
  probeKernel(bench, "probes/probe_texture.cl", "probeTexture",
              fmt::format("-D WIDTH={} -D PROBE_TEXEL_SIZE={}", width, texel_size))
      .launch(args, n / static_cast<std::size_t>(width), kLocalSize);
  out.read(words.data(), words.size() * 4);

  std::vector<FetchedTexel> fetched(pixels.size());
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t c = 0; c < components; ++c) fetched[i].values.push_back(words[c * n + i]);
    fetched[i].count = static_cast<int>(words[components * n + i]);
    fetched[i].rows = static_cast<int>(words[(components + 1) * n + i]);
    fetched[i].level = words[(components + 2) * n + i];
    fetched[i].true_spread = words[(components + 3) * n + i];
  }
  return fetched;
}

}  // namespace glintmark
