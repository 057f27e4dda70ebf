// Mattes are what compositing programs look for.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "host/core/error.h"
#include "host/report/picture/cryptomatte.h"

namespace glintmark {
namespace {

// Test vectors that go round with the algorithm, of every length of the last block.
TEST(Cryptomatte, HashIsMurmurs) {
  EXPECT_EQ(murmurHash3(""), 0u);
  EXPECT_EQ(murmurHash3("test"), 0xba6bd213u);
  EXPECT_EQ(murmurHash3("Hello, world!"), 0xc0363e43u);
  EXPECT_EQ(murmurHash3("The quick brown fox jumps over the lazy dog"), 0x2e4ff723u);
}

// The keys that other programs write for layers of these names.
TEST(Cryptomatte, LayerHasTheKeyThatOthersGiveIt) {
  const std::string materials[] = {"steel", "cloth \"a\""};
  const PictureFacts facts = matteFacts(materials);
  ASSERT_EQ(facts.size(), 4u);
  EXPECT_EQ(facts[0].first, "cryptomatte/bda530a/name");
  EXPECT_EQ(facts[0].second, "crypto_material");
  const auto manifest = nlohmann::json::parse(facts[3].second);
  for (const std::string& name : materials) {
    const auto bits =
        static_cast<std::uint32_t>(std::stoul(manifest.at(name).get<std::string>(), nullptr, 16));
    EXPECT_EQ(std::bit_cast<std::uint32_t>(cryptomatteId(name)), bits);
  }
}

TEST(Cryptomatte, IdsAreOrdinaryNumbers) {
  int flipped = 0;
  for (int i = 0; i < 20000; ++i) {
    const std::string name = "material " + std::to_string(i);
    EXPECT_TRUE(std::isnormal(cryptomatteId(name))) << name;
    flipped += std::bit_cast<std::uint32_t>(cryptomatteId(name)) != murmurHash3(name) ? 1 : 0;
  }
  EXPECT_GT(flipped, 0);
}

TEST(Cryptomatte, PixelsHaveTheirMaterialsId) {
  Image planes(3, 1, 2);
  planes.channel_names = {"Z", "material"};
  planes.pixels = {5, 1, 6, -1, 7, 0};
  const std::string materials[] = {"a", "b"};
  addMaterialMatte(planes, materials);
  EXPECT_EQ(planes.channel_names,
            (std::vector<std::string>{"Z", "material", "crypto_material00.R", "crypto_material00.G",
                                      "crypto_material00.B", "crypto_material00.A"}));
  EXPECT_EQ(planes.pixels, (std::vector<float>{5, 1, cryptomatteId("b"), 1, 0, 0, 6, -1, 0, 0, 0, 0,
                                               7, 0, cryptomatteId("a"), 1, 0, 0}));
  const std::string one[] = {"a"};
  planes.pixels[1] = 3;
  EXPECT_THROW(addMaterialMatte(planes, one), Error);
  planes.channel_names[1] = "other";
  EXPECT_THROW(addMaterialMatte(planes, one), Error);
}

}  // namespace
}  // namespace glintmark
