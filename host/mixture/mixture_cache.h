// Fitted mixtures on disk, by the content of the map and everything that decides the fit.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "host/core/disk_cache.h"
#include "host/mixture/normal_mixture.h"

namespace glintmark {

/// Counts up whenever the fit or the layout changes what comes out.
inline constexpr std::uint32_t kMixtureVersion = 2;

/// What a fit depends on, as text: version of the fit, size and hash of the normals, options.
/// The number of threads is not part of it.
std::string mixtureKey(const NormalMap& map, const MixtureOptions& options);

/// Bytes of fitted mixtures in the machine's order.
std::string mixtureBytes(const NormalMixtures& mixtures);
/// Inverse of mixtureBytes; nothing if the bytes are of another version or not whole.
std::optional<NormalMixtures> mixturesFromBytes(std::string_view bytes);

/// What `cache` has under a key of mixtureKey; nothing if it has none, or not whole.
std::optional<NormalMixtures> loadMixtures(const DiskCache& cache, const std::string& key);
void storeMixtures(const DiskCache& cache, const std::string& key, const NormalMixtures& mixtures);

struct CachedMixtures {
  NormalMixtures mixtures;
  bool from_cache = false;  // fit_ms and the levels' report are then those of the first fit
};

/// Mixtures from `cache`, or fitted and stored there. Throws Error like fitNormalMixtures.
CachedMixtures cachedNormalMixtures(const NormalMap& map, const MixtureOptions& options,
                                    const DiskCache& cache,
                                    const std::function<void(double)>& progress = {});

}  // namespace glintmark
