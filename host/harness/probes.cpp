#include "host/harness/probes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "host/ocl/switches.h"

namespace glintmark {
namespace {

template <typename T>
Buffer paddedData(KernelBench& bench, std::vector<T> values) {
  values.resize(paddedCount(values.size()), values.empty() ? T{} : values.back());
  return probeData(bench, values);
}

template <typename T>
std::vector<T> download(const Buffer& buffer, std::size_t first, std::size_t count) {
  std::vector<T> values(first + count);
  buffer.read(values.data(), values.size() * 4);
  return {values.begin() + static_cast<std::ptrdiff_t>(first), values.end()};
}

void launch(KernelBench& bench, const std::string& file, const std::string& name,
            const std::string& switches, int width, const std::vector<KernelArg>& args,
            std::size_t padded) {
  probeKernel(bench, file, name, fmt::format("-D WIDTH={} {}", width, switches))
      .launch(args, padded / static_cast<std::size_t>(width), kLocalSize);
}

Buffer makeOutput(KernelBench& bench, std::size_t words) {
  return Buffer(bench.device, words * 4, BufferPurpose::kProbe);
}

}  // namespace

std::vector<float> probeMath(KernelBench& bench, MathFunction function, const std::vector<float>& x,
                             int width) {
  const std::size_t padded = paddedCount(x.size());
  Buffer out = makeOutput(bench, padded);
  launch(bench, "probes/probe_glint.cl", "probeMath", "", width,
         {paddedData(bench, x), out, static_cast<std::uint32_t>(padded),
          static_cast<std::int32_t>(function)},
         padded);
  return download<float>(out, 0, x.size());
}

HashProbe probeHash(KernelBench& bench, const std::vector<std::int32_t>& cell_u,
                    const std::vector<std::int32_t>& cell_v, const std::vector<std::int32_t>& ju,
                    const std::vector<std::int32_t>& jv, int width) {
  const std::size_t n = cell_u.size(), padded = paddedCount(n);
  Buffer out = makeOutput(bench, 3 * padded);
  launch(bench, "probes/probe_glint.cl", "probeHash", "", width,
         {paddedData(bench, cell_u), paddedData(bench, cell_v), paddedData(bench, ju),
          paddedData(bench, jv), out, static_cast<std::uint32_t>(padded)},
         padded);
  return {download<std::uint32_t>(out, 0, n), download<std::uint32_t>(out, padded, n),
          download<std::uint32_t>(out, 2 * padded, n)};
}

RandomProbe probeRandom(KernelBench& bench, const std::vector<std::uint32_t>& bits, int width) {
  const std::size_t padded = paddedCount(bits.size());
  Buffer out = makeOutput(bench, 2 * padded);
  launch(bench, "probes/probe_glint.cl", "probeRandom", "", width,
         {paddedData(bench, bits), out, static_cast<std::uint32_t>(padded)}, padded);
  return {download<float>(out, 0, bits.size()), download<float>(out, padded, bits.size())};
}

FootprintProbe probeFootprints(KernelBench& bench,
                               const std::vector<reference::PixelFootprint>& footprints,
                               const GlintMaterial& glints, GlintMethod method, int ka, int width) {
  const std::size_t n = footprints.size(), padded = paddedCount(n);
  std::vector<std::uint32_t> planes(8 * padded);
  for (std::size_t i = 0; i < padded; ++i) {
    const reference::PixelFootprint& f = footprints[std::min(i, n - 1)];
    const auto bits = [](double d) { return std::bit_cast<std::uint32_t>(static_cast<float>(d)); };
    const std::uint32_t words[] = {static_cast<std::uint32_t>(f.u.integer),
                                   f.u.fraction,
                                   static_cast<std::uint32_t>(f.v.integer),
                                   f.v.fraction,
                                   bits(f.duv_dx.x),
                                   bits(f.duv_dx.y),
                                   bits(f.duv_dy.x),
                                   bits(f.duv_dy.y)};
    for (std::size_t k = 0; k < 8; ++k) planes[k * padded + i] = words[k];
  }
  Buffer out = makeOutput(bench, 4 * padded);
  launch(bench, "probes/probe_glint.cl", "probeFootprint",
         fmt::format("-D GLINT_METHOD={} -D KA={}", choiceName(method), ka), width,
         {paddedData(bench, planes), out, static_cast<std::uint32_t>(padded),
          probeData(bench, std::vector{glints})},
         padded);
  return {download<float>(out, 0, n), download<float>(out, padded, n),
          download<float>(out, 2 * padded, n), download<float>(out, 3 * padded, n)};
}

std::vector<float> probeBinomial(KernelBench& bench, const std::vector<std::uint32_t>& bits,
                                 const std::vector<float>& n, const std::vector<float>& p,
                                 GlintMethod method, int width) {
  const std::size_t padded = paddedCount(bits.size());
  Buffer out = makeOutput(bench, padded);
  launch(bench, "probes/probe_binomial.cl", "probeBinomial",
         fmt::format("-D GLINT_METHOD={}", choiceName(method)), width,
         {paddedData(bench, bits), paddedData(bench, n), paddedData(bench, p), out,
          static_cast<std::uint32_t>(padded)},
         padded);
  return download<float>(out, 0, bits.size());
}

std::vector<float> probeSineHash(KernelBench& bench, const std::vector<float>& n, int width) {
  const std::size_t padded = paddedCount(n.size());
  Buffer out = makeOutput(bench, padded);
  launch(bench, "probes/probe_published.cl", "probeSineHash", "", width,
         {paddedData(bench, n), out, static_cast<std::uint32_t>(padded)}, padded);
  return download<float>(out, 0, n.size());
}

std::vector<float> probePublishedBinomial(KernelBench& bench, const std::vector<float>& u,
                                          const std::vector<float>& n, const std::vector<float>& p,
                                          int width) {
  const std::size_t padded = paddedCount(u.size());
  Buffer out = makeOutput(bench, padded);
  launch(bench, "probes/probe_published.cl", "probePublishedBinomial", "", width,
         {paddedData(bench, u), paddedData(bench, n), paddedData(bench, p), out,
          static_cast<std::uint32_t>(padded)},
         padded);
  return download<float>(out, 0, u.size());
}

}  // namespace glintmark
