#include "host/mixture/mixture_cache.h"

#include <fmt/format.h>

#include <cstring>
#include <type_traits>

#include "host/core/fnv1a.h"
#include "host/core/free_memory.h"

namespace glintmark {
namespace {

struct Header {
  std::uint32_t version = kMixtureVersion;
  std::int32_t width_px = 0, height_px = 0, lobes = 0;
  double fit_ms = 0;
};

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

// Takes `count` values off the front; false if there are not as many.
template <class T>
bool take(std::string_view& bytes, T* values, std::size_t count) {
  const std::size_t size = count * sizeof(T);
  if (bytes.size() < size) return false;
  std::memcpy(values, bytes.data(), size);
  bytes.remove_prefix(size);
  return true;
}

bool isSane(const Header& header) {
  return header.version == kMixtureVersion && header.width_px >= 1 && header.height_px >= 1 &&
         header.width_px <= kMaxNormalMapSize_px && header.height_px <= kMaxNormalMapSize_px &&
         header.lobes >= 1 && header.lobes <= kMaxLobes;
}

// What stands before the texels.
std::string headBytes(const NormalMixtures& mixtures) {
  const MipTexture& layout = mixtures.moments.layout;
  const Header header{.width_px = static_cast<std::int32_t>(layout.width),
                      .height_px = static_cast<std::int32_t>(layout.height),
                      .lobes = mixtures.lobes,
                      .fit_ms = mixtures.fit_ms};
  std::string bytes;
  append(bytes, &header, 1);
  append(bytes, mixtures.levels.data(), mixtures.levels.size());
  return bytes;
}

std::string_view texelBytes(const NormalMixtures& mixtures) {
  const LargeArray<float4>& texels = mixtures.moments.texels;
  return {reinterpret_cast<const char*>(texels.data()), texels.size() * sizeof(float4)};
}

}  // namespace

std::string mixtureKey(const NormalMap& map, const MixtureOptions& options) {
  const std::string_view normals{reinterpret_cast<const char*>(map.normals.data()),
                                 map.normals.size() * sizeof(glm::vec3)};
  return fmt::format(
      "mixtures {} of {}x{} normals {:016x}: {} lobes, {}, {} passes, {} sweeps,"
      " {} iterations,"
      " tolerance {}, prior {}",
      kMixtureVersion, map.width_px, map.height_px, fnv1a(normals), options.lobes,
      mixtureOrderName(options.order), options.passes, options.sweeps, options.max_iterations,
      options.tolerance, options.prior_weight,
      options.surface == MixtureSurface::kTexels ? "texels" : "interpolated");
}

std::string mixtureBytes(const NormalMixtures& mixtures) {
  const std::string_view texels = texelBytes(mixtures);
  std::string bytes = headBytes(mixtures);
  bytes.reserve(bytes.size() + texels.size());
  return bytes.append(texels);
}

std::optional<NormalMixtures> mixturesFromBytes(std::string_view bytes) {
  Header header;
  if (!take(bytes, &header, 1) || !isSane(header)) return std::nullopt;
  NormalMixtures result;
  result.lobes = header.lobes;
  result.fit_ms = header.fit_ms;
  result.levels.resize(static_cast<std::size_t>(mipLevelCount(header.width_px, header.height_px)));
  if (!take(bytes, result.levels.data(), result.levels.size())) return std::nullopt;
  // Before anything of that size is allocated.
  const MipTexture layout = makeMipTexture(header.width_px, header.height_px);
  const std::size_t texels_size =
      (layout.first[layout.level_count - 1] + std::size_t{1}) * header.lobes;
  if (bytes.size() != texels_size * sizeof(float4)) return std::nullopt;
  result.moments = makeMipTexels(header.width_px, header.height_px, header.lobes);
  LargeArray<float4>& texels = result.moments.texels;
  if (!take(bytes, texels.data(), texels.size())) return std::nullopt;
  return result;
}

std::optional<NormalMixtures> loadMixtures(const DiskCache& cache, const std::string& key) {
  constexpr std::size_t kSmall_bytes = std::size_t{64} << 20;
  const auto bytes = cache.load(key, key);
  if (!bytes) return std::nullopt;
  // The entry and its copy lie side by side; a fit takes less.
  const std::uint64_t free_bytes = bytes->size() > kSmall_bytes ? freeMemoryBytes() : 0;
  if (free_bytes > 0 && free_bytes < bytes->size()) return std::nullopt;
  return mixturesFromBytes(*bytes);
}

// In pieces, since a copy of a large map's would not fit the memory.
void storeMixtures(const DiskCache& cache, const std::string& key, const NormalMixtures& mixtures) {
  cache.store(key, key, headBytes(mixtures), texelBytes(mixtures));
}

CachedMixtures cachedNormalMixtures(const NormalMap& map, const MixtureOptions& options,
                                    const DiskCache& cache,
                                    const std::function<void(double)>& progress) {
  checkNormalMap(map);
  const std::string key = mixtureKey(map, options);
  // Entries of other keys stay: scenes have several maps and fits.
  if (auto mixtures = loadMixtures(cache, key)) return {std::move(*mixtures), true};
  NormalMixtures mixtures = fitNormalMixtures(map, options, progress);
  storeMixtures(cache, key, mixtures);
  return {std::move(mixtures), false};
}

}  // namespace glintmark
