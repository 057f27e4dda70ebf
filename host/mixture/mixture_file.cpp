#include "host/mixture/mixture_file.h"

#include <fmt/format.h>

#include <cstring>

#include "host/core/error.h"
#include "host/core/fnv1a.h"
#include "host/mixture/mixture_cache.h"

namespace glintmark {
namespace {

constexpr std::string_view kMagic = "glintmark.mixtures/";

}  // namespace

std::string serializeMixtures(const NormalMixtures& mixtures) {
  std::string file = mixtureBytes(mixtures);
  const std::uint64_t hash = fnv1a(file);
  file.insert(0, fmt::format("{}{}\n", kMagic, kMixtureVersion));
  file.append(reinterpret_cast<const char*>(&hash), sizeof hash);
  return file;
}

NormalMixtures parseMixtures(std::string_view file, const std::string& name) {
  if (!file.starts_with(kMagic)) {
    throw Error(
        fmt::format("'{}' is not a file of mixtures; `glintmark fit gmm -o` writes them", name));
  }
  const std::string_view version = file.substr(kMagic.size(), file.find('\n') - kMagic.size());
  if (version != std::to_string(kMixtureVersion)) {
    throw Error(
        fmt::format("'{}' holds mixtures of version {}; this program reads version {}; fit "
                    "the map again",
                    name, version.substr(0, 10), kMixtureVersion));
  }
  std::string_view bytes = file.substr(std::min(file.size(), kMagic.size() + version.size() + 1));
  std::uint64_t hash = 0;
  if (bytes.size() >= sizeof hash) {
    std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
    bytes.remove_suffix(sizeof hash);
    if (fnv1a(bytes) == hash) {
      if (auto mixtures = mixturesFromBytes(bytes)) return std::move(*mixtures);
    }
  }
  throw Error(fmt::format("'{}' is truncated or damaged; fit the map again", name));
}

}  // namespace glintmark
