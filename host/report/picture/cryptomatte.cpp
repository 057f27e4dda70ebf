#include "host/report/picture/cryptomatte.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>

#include "host/core/error.h"

namespace glintmark {
namespace {

constexpr const char* kLayer = "crypto_material";
constexpr const char* kRanks[] = {"R", "G", "B", "A"};  // id, coverage, second id, its coverage

// One block of MurmurHash3, up to four bytes, made ready to be mixed in.
std::uint32_t scrambled(std::uint32_t block) {
  return std::rotl(block * 0xcc9e2d51u, 15) * 0x1b873593u;
}

std::uint32_t blockAt(std::string_view text, std::size_t begin) {
  std::uint32_t block = 0;
  for (std::size_t i = 0; i < 4 && begin + i < text.size(); ++i)
    block |= static_cast<std::uint32_t>(static_cast<unsigned char>(text[begin + i])) << 8 * i;
  return block;
}

std::uint32_t idBits(std::string_view name) {
  const std::uint32_t hash = murmurHash3(name), exponent = hash >> 23 & 255;
  return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

}  // namespace

std::uint32_t murmurHash3(std::string_view text) {
  std::uint32_t hash = 0;
  const std::size_t whole = text.size() / 4 * 4;
  for (std::size_t i = 0; i < whole; i += 4)
    hash = std::rotl(hash ^ scrambled(blockAt(text, i)), 13) * 5 + 0xe6546b64u;
  if (whole < text.size()) hash ^= scrambled(blockAt(text, whole));
  hash ^= static_cast<std::uint32_t>(text.size());
  hash = (hash ^ hash >> 16) * 0x85ebca6bu;
  hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
  return hash ^ hash >> 16;
}

float cryptomatteId(std::string_view name) {
  return std::bit_cast<float>(idBits(name));
}

void addMaterialMatte(Image& planes, std::span<const std::string> materials) {
  const auto found = std::ranges::find(planes.channel_names, "material");
  if (found == planes.channel_names.end()) throw Error("the planes have no channel 'material'");
  const auto index = static_cast<std::size_t>(found - planes.channel_names.begin());
  Image wider(planes.width, planes.height, planes.channels + 4);
  wider.channel_names = planes.channel_names;
  for (const char* rank : kRanks)
    wider.channel_names.push_back(fmt::format("{}00.{}", kLayer, rank));
  for (int y = 0; y < planes.height; ++y)
    for (int x = 0; x < planes.width; ++x) {
      const auto from = planes.at(x, y);
      const auto to = wider.at(x, y);
      std::ranges::copy(from, to.begin());
      if (from[index] < 0) continue;
      const auto material = static_cast<std::size_t>(from[index]);
      if (material >= materials.size())
        throw Error(fmt::format("there are {} materials, but a pixel shows number {}",
                                materials.size(), material));
      to[from.size()] = cryptomatteId(materials[material]);
      to[from.size() + 1] = 1;
    }
  planes = std::move(wider);
}

PictureFacts matteFacts(std::span<const std::string> materials) {
  const std::string key =
      "cryptomatte/" + fmt::format("{:08x}", murmurHash3(kLayer)).substr(0, 7) + "/";
  nlohmann::ordered_json manifest = nlohmann::ordered_json::object();
  for (const std::string& name : materials) manifest[name] = fmt::format("{:08x}", idBits(name));
  return {{key + "name", kLayer},
          {key + "hash", "MurmurHash3_32"},
          {key + "conversion", "uint32_to_float32"},
          {key + "manifest", manifest.dump()}};
}

}  // namespace glintmark
