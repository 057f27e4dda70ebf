#include "host/frame/effect/normal_maps.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/core/progress.h"
#include "host/filter/interpolated_normals.h"
#include "host/filter/normal_moments.h"
#include "host/mixture/fournier_peaks.h"
#include "host/mixture/half_mixtures.h"
#include "host/mixture/lobe_statistics.h"
#include "host/mixture/mixture_cache.h"
#include "host/ocl/upload.h"

namespace glintmark {
namespace {

using TexelRange = tbb::blocked_range<std::size_t>;
constexpr std::size_t kTexelsAtOnce = 65536;

// A fit of a large map takes minutes.
NormalMixtures fittedMixtures(const NormalMap& map, const MixtureOptions& options,
                              const DiskCache& cache) {
  Progress progress(false);
  return cachedNormalMixtures(map, options, cache,
                              [&](double share) {
                                progress.show(static_cast<int>(share * 100), 100,
                                              fmt::format("% of the mixtures of map {}", map.name));
                              })
      .mixtures;
}

// The map's own normals, a texture of one level: every footprint is read at the finest.
MipTexels finestNormals(const NormalMap& map) {
  requireMemory(map.normals.size() * sizeof(float4), fmt::format("map '{}'", map.name));
  MipTexels texels;
  texels.layout.width = static_cast<uint>(map.width_px);
  texels.layout.height = static_cast<uint>(map.height_px);
  texels.layout.level_count = 1;
  texels.texels.resize(map.normals.size());
  tbb::parallel_for(TexelRange(0, map.normals.size(), kTexelsAtOnce), [&](const TexelRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const glm::vec3& n = map.normals[i];
      texels.texels[i] = {n.x, n.y, n.z, 0};
    }
  });
  return texels;
}

template <typename Texels>
NormalTexture uploadTexture(Device& device, const MipTexture& layout, Texels&& texels,
                            std::size_t texel_bytes) {
  return {upload(device, std::vector{layout}, BufferPurpose::kNormalMapLayouts),
          upload(device, std::forward<Texels>(texels), BufferPurpose::kNormalMaps), texel_bytes};
}

// Moments smaller than this are 0 to every method. A lobe that a texel does not use keeps some
// 2^-126 of its normals, and sums of such numbers are denormal, which costs processors with
// microcode for them a hundred cycles each.
constexpr float kLeastMoment = 1e-20f;

void dropLeastMoments(LargeArray<float4>& texels) {
  tbb::parallel_for(TexelRange(0, texels.size(), kTexelsAtOnce), [&](const TexelRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      for (float* value : {&texels[i].x, &texels[i].y, &texels[i].z, &texels[i].w})
        if (std::abs(*value) < kLeastMoment) *value = 0;
  });
}

NormalTexture uploadTexture(Device& device, MipTexels texels) {
  dropLeastMoments(texels.texels);
  return uploadTexture(device, texels.layout, std::move(texels.texels),
                       static_cast<std::size_t>(texels.vectors) * sizeof(float4));
}

// Without the finest level.
MipTexels coarserLevels(const MipTexels& chain) {
  MipTexels rest{makeMipTexture(chain.levelWidth(1), chain.levelHeight(1)), chain.vectors, {}};
  const auto skipped = static_cast<std::ptrdiff_t>(chain.layout.first[1]) * chain.vectors;
  rest.texels.assign(chain.texels.begin() + skipped, chain.texels.end());
  return rest;
}

// Narrow lobes under area lights show what mixing lobes of one index over texels widens. One step a
// sweep and more sweeps, in each of which a texel sees its neighbours anew, keep them closer
// together than many steps of few sweeps do (docs/accuracy.md).
constexpr int kAreaSweeps = 2, kAreaIterations = 1;

// Mixtures of the surface between the map's texels at the finest level too, where AREA_MIXTURE
// programs want it; `iterations` 0: kAreaIterations.
NormalMixtures interpolatedMixtures(const NormalMap& map, MixtureOptions options, int iterations,
                                    const DiskCache& cache) {
  options.surface = MixtureSurface::kTexels;
  options.sweeps = kAreaSweeps;
  if (iterations == 0) options.max_iterations = kAreaIterations;
  // Several normals stand for one texel of the map.
  options.prior_weight *= static_cast<float>(kSurfaceSamples * kSurfaceSamples);
  NormalMixtures mixtures =
      fittedMixtures(interpolatedNormals(map, kSurfaceSamples), options, cache);
  mixtures.moments = coarserLevels(mixtures.moments);
  return mixtures;
}

NormalTexture uploadMixtures(Device& device, const NormalMap& map, int lobes, bool half,
                             MixtureOrder order, int iterations, bool for_area_lights) {
  const MixtureOptions options = mixtureOptions(lobes, order, iterations);
  const DiskCache cache = DiskCache::fromEnvironment();
  NormalMixtures mixtures = for_area_lights ? interpolatedMixtures(map, options, iterations, cache)
                                            : fittedMixtures(map, options, cache);
  if (!half) return uploadTexture(device, std::move(mixtures.moments));
  return uploadTexture(device, mixtures.moments.layout, packHalfMixtures(mixtures),
                       static_cast<std::size_t>(lobes) * 4 * sizeof(std::uint16_t));
}

// The lobes of the same fit, stored otherwise.
NormalTexture uploadLobes(Device& device, const NormalMap& map, NormalMethod method, int lobes,
                          MixtureOrder order, int iterations) {
  const MixtureOptions options = mixtureOptions(lobes, order, iterations);
  const NormalMixtures mixtures = fittedMixtures(map, options, DiskCache::fromEnvironment());
  return uploadTexture(device, method == NormalMethod::kVmfLobes
                                   ? sphereLobes(map, mixtures, options.surface)
                                   : covarianceLobes(map, mixtures, options.surface));
}

NormalTexture makeTexture(Device& device, const NormalMap& map, NormalMethod method, int lobes,
                          bool half, MixtureOrder order, int iterations, bool for_area_lights) {
  switch (method) {
    case NormalMethod::kFixed:
      return uploadTexture(device, finestNormals(map));
    case NormalMethod::kMip:
    case NormalMethod::kToksvig:
    case NormalMethod::kVmf:
      // One lobe under area lights errs less by means of the texels alone.
      return uploadTexture(device, meanNormals(map, !for_area_lights));
    case NormalMethod::kLean:
    case NormalMethod::kLeadr:
      return uploadTexture(device, leanMoments(map));
    case NormalMethod::kFournier:
      return uploadTexture(device, fournierPeaks(map, lobes));
    case NormalMethod::kGmm:
      return uploadMixtures(device, map, lobes, half, order, iterations, for_area_lights);
    case NormalMethod::kVmfLobes:
    case NormalMethod::kAnisotropic:
      return uploadLobes(device, map, method, lobes, order, iterations);
  }
  throw Error("the normal method is unknown; it must be 0 (mip) to 9 (leadr)");
}

// Whether the finest level of a mixture is of the surface between the map's texels, too.
bool mixesSurface(const KernelConfig& config, int width_px, int height_px) {
  return config.normal_method == NormalMethod::kGmm && config.ltc_method == LtcMethod::kMixture &&
         canInterpolate(width_px, height_px);
}

std::uint64_t chainBytes(int width_px, int height_px, int vectors) {
  const MipTexture layout = makeMipTexture(width_px, height_px);
  return (layout.first[layout.level_count - 1] + std::uint64_t{1}) *
         static_cast<std::uint64_t>(vectors) * sizeof(float4);
}

TextureNeed mixtureNeed(int width_px, int height_px, const KernelConfig& config) {
  const std::uint64_t own = chainBytes(width_px, height_px, config.lobes);
  if (mixesSurface(config, width_px, height_px)) {
    const int width = kSurfaceSamples * width_px, height = kSurfaceSamples * height_px;
    MixtureOptions options = mixtureOptions(config.lobes, MixtureOrder::kColours, 0);
    options.surface = MixtureSurface::kTexels;
    const std::uint64_t fine =
        normalMapBytes(width, height, false) + mixtureFitBytes(width, height, options);
    return {config.half_texels ? own / 2 : own, fine + own};
  }
  const std::uint64_t fit =
      mixtureFitBytes(width_px, height_px, mixtureOptions(config.lobes, MixtureOrder::kColours, 0));
  if (!config.half_texels) return {own, fit};
  return {own / 2, std::max(fit, own + own / 2)};
}

}  // namespace

TextureNeed textureNeed(int width_px, int height_px, const KernelConfig& config) {
  const auto chain = [&](int vectors) { return chainBytes(width_px, height_px, vectors); };
  const auto alone = [](std::uint64_t bytes) { return TextureNeed{bytes, bytes}; };
  const auto moments = [&](int vectors) {
    return momentBytes(width_px, height_px, vectors, canInterpolate(width_px, height_px));
  };
  const auto fit = [&](int lobes) {
    return mixtureFitBytes(width_px, height_px, mixtureOptions(lobes, MixtureOrder::kColours, 0));
  };
  switch (config.normal_method) {
    case NormalMethod::kFixed:
      return alone(static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(height_px) *
                   sizeof(float4));
    case NormalMethod::kMip:
    case NormalMethod::kToksvig:
    case NormalMethod::kVmf:
      return {chain(1), moments(1)};
    case NormalMethod::kLean:
    case NormalMethod::kLeadr:
      return {chain(2), moments(2)};
    case NormalMethod::kFournier:
      return {chain(config.peaks), fit(config.peaks)};
    case NormalMethod::kGmm:
      return mixtureNeed(width_px, height_px, config);
    case NormalMethod::kVmfLobes:
      return {chain(config.lobes), fit(config.lobes) + chain(config.lobes)};
    case NormalMethod::kAnisotropic:
      return {chain(covarianceVectors(config.lobes)),
              fit(config.lobes) + chain(covarianceVectors(config.lobes))};
  }
  return {};
}

bool readsMixture(NormalMethod method) {
  return method == NormalMethod::kGmm || method == NormalMethod::kVmfLobes ||
         method == NormalMethod::kAnisotropic;
}

std::string withoutAnisotropicNote(const std::string& scene) {
  return fmt::format(
      "note: scene {} has more lobes than the {} that method anisotropic takes, which is left out",
      scene, kMostAnisotropicLobes);
}

bool takesLobesOf(NormalMethod method, const Scene& scene) {
  return method != NormalMethod::kAnisotropic ||
         std::ranges::none_of(scene.materials, [](const Material& material) {
           return material.normal_map && material.normal_map->lobes > kMostAnisotropicLobes;
         });
}

MixtureOptions mixtureOptions(int lobes, MixtureOrder order, int iterations) {
  MixtureOptions options{.lobes = lobes, .surface = MixtureSurface::kInterpolated, .order = order};
  if (iterations > 0) options.max_iterations = iterations;
  return options;
}

const NormalTexture& NormalTextures::get(const std::shared_ptr<const NormalMap>& map,
                                         const KernelConfig& config, MixtureOrder order,
                                         int iterations) {
  // Methods that read the same texture share it.
  NormalMethod method = config.normal_method;
  if (method == NormalMethod::kMip || method == NormalMethod::kVmf) method = NormalMethod::kToksvig;
  if (method == NormalMethod::kLeadr) method = NormalMethod::kLean;
  const bool mixture = readsMixture(method);
  const bool gmm = method == NormalMethod::kGmm;
  const bool for_area_lights = gmm ? mixesSurface(config, map->width_px, map->height_px)
                                   : config.ltc && method == NormalMethod::kToksvig;
  const int lobes = mixture ? config.lobes : method == NormalMethod::kFournier ? config.peaks : 0;
  const Key key = {map,
                   method,
                   lobes,
                   gmm && config.half_texels,
                   mixture ? order : MixtureOrder::kColours,
                   mixture ? iterations : 0,
                   for_area_lights};
  const auto found = textures_.find(key);
  if (found != textures_.end()) return found->second;
  return textures_
      .emplace(key, makeTexture(device_, *map, method, lobes, config.half_texels, order, iterations,
                                for_area_lights))
      .first->second;
}

const NormalTexture& NormalTextures::finest(const std::shared_ptr<const NormalMap>& map) {
  KernelConfig config;
  config.normal_method = NormalMethod::kFixed;
  return get(map, config);
}

std::size_t NormalTextures::bytes() const {
  std::size_t total = 0;
  for (const auto& [key, texture] : textures_) total += texture.texels.bytes();
  return total;
}

}  // namespace glintmark
