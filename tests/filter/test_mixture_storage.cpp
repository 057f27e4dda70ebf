// Stored mixtures: closed-form filtering, half precision, linear moments, the cache.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <random>

#include "host/core/error.h"
#include "host/filter/normal_map_generators.h"
#include "host/filter/normal_moments.h"
#include "host/mixture/half_mixtures.h"
#include "host/mixture/mixture_cache.h"
#include "host/mixture/mixture_error.h"
#include "host/mixture/mixture_file.h"
#include "tests/damaged_bytes.h"

namespace glintmark {
namespace {
namespace fs = std::filesystem;

// Second moments of magnitude 1 in single precision.
constexpr double kMomentRounding = 5e-7;
// Half an ulp of a half, relative.
constexpr double kHalfRounding = 1.0 / 2048;

// [TAN05] appendix: filtering moments is pooling the samples of one lobe.
TEST(MixtureStorage, FilteringIsPoolingInDoublePrecision) {
  std::mt19937 random(2);
  const auto uniform = [&] { return random() * 0x1p-32; };
  for (int trial = 0; trial < 200; ++trial) {
    float4 filtered;
    double weight = 0, squares = 0, left = 1;
    glm::dvec2 mean(0);
    for (int texel = 0; texel < 8; ++texel) {
      const double share = texel == 7 ? left : left * uniform();
      left -= share;
      // Some texels do not have the lobe at all, some nothing else.
      const double choice = uniform();
      NormalLobe lobe;
      lobe.weight = static_cast<float>(choice < 0.3 ? 0 : choice < 0.5 ? 1 : uniform());
      lobe.mean = 0.7f * glm::vec2(2 * uniform() - 1, 2 * uniform() - 1);
      lobe.variance = static_cast<float>(choice > 0.8 ? 0 : 0.1 * uniform());
      const float4 m = lobeMoments(lobe);
      const auto s = static_cast<float>(share);
      filtered.x += s * m.x, filtered.y += s * m.y, filtered.z += s * m.z, filtered.w += s * m.w;
      const double a = share * lobe.weight;
      weight += a, mean += a * glm::dvec2(lobe.mean);
      squares += a * (2.0 * lobe.variance + glm::dot(glm::dvec2(lobe.mean), glm::dvec2(lobe.mean)));
    }
    const NormalLobe result = lobeFromMoments(filtered);
    EXPECT_NEAR(result.weight, weight, 1e-6);
    if (weight < 0.01) continue;
    mean /= weight;
    const double variance = 0.5 * (squares / weight - glm::dot(mean, mean));
    EXPECT_LT(glm::length(glm::dvec2(result.mean) - mean), 1e-4);
    EXPECT_NEAR(result.variance, variance, kMomentRounding / weight);
    EXPECT_GE(result.variance, 0);
  }
}

TEST(MixtureStorage, ALobeOfNoWeightIsZero) {
  const NormalLobe lobe = lobeFromMoments({0, 0, 0, 0});
  EXPECT_EQ(lobe.weight, 0);
  EXPECT_EQ(lobe.variance, 0);
  EXPECT_EQ(lobeFromMoments({1, 0.5f, 0, 0.2f}).variance, 0) << "rounding below 0";
}

TEST(MixtureStorage, DistanceOfMixturesIsThatOfTheirDensities) {
  const ReferenceLobe a[] = {{0.7, {0.1, 0.0}, 0.01}, {0.3, {-0.2, 0.1}, 0.02}};
  const ReferenceLobe b[] = {{1.0, {0.0, 0.05}, 0.03}};
  constexpr double kWidening = 0.005, kStep = 0.01;
  const auto density = [&](std::span<const ReferenceLobe> lobes, glm::dvec2 at) {
    double sum = 0;
    for (const ReferenceLobe& l : lobes) {
      const double v = l.variance + kWidening;
      const glm::dvec2 d = at - l.mean;
      sum += l.weight * std::exp(-0.5 * glm::dot(d, d) / v) / (2 * 3.14159265358979 * v);
    }
    return sum;
  };
  double difference = 0, norm = 0;
  for (double y = -1.2; y < 1.2; y += kStep) {
    for (double x = -1.2; x < 1.2; x += kStep) {
      const double p = density(a, {x, y}), q = density(b, {x, y});
      difference += (p - q) * (p - q), norm += q * q;
    }
  }
  EXPECT_NEAR(mixtureDistance(a, b, kWidening), difference / norm, 1e-6);
  EXPECT_EQ(mixtureDistance(b, b, kWidening), 0);
}

TEST(HalfMixtures, KeepNarrowLobes) {
  NormalMixtures mixtures;
  mixtures.lobes = 1;
  mixtures.moments = makeMipTexels(1, 1, 1);
  for (const float deviation : {0.0f, 0.002f, 0.02f, 0.3f}) {
    const NormalLobe lobe{0.8f, {0.3f, -0.35f}, deviation * deviation};
    mixtures.moments.texels[0] = lobeMoments(lobe);
    const auto halves = packHalfMixtures(mixtures);
    ASSERT_EQ(halves.size(), 4u);
    const NormalLobe back = lobeFromHalves(halves.data());
    EXPECT_NEAR(back.weight, lobe.weight, lobe.weight * kHalfRounding);
    EXPECT_NEAR(back.mean.x, lobe.mean.x, 0.3 * kHalfRounding);
    EXPECT_NEAR(back.mean.y, lobe.mean.y, 0.35 * kHalfRounding);
    // What the moments themselves lost in single precision comes on top.
    EXPECT_NEAR(back.variance, lobe.variance, 2.1 * lobe.variance * kHalfRounding + 1e-7);
  }
}

TEST(NormalMoments, ToksvigAndLeanOfTwoSlopes) {
  NormalMap map{"ridge", 2, 1, {{0.6f, 0, 0.8f}, {-0.6f, 0, 0.8f}}};
  const MipTexels means = meanNormals(map);
  EXPECT_NEAR(means.at(1, 0, 0)->x, 0, 1e-7);
  // A quarter of a texel from either centre the map's slope is half as steep, (0.3, 0, 0.8).
  EXPECT_NEAR(means.at(0, 0, 0)->z, 0.8, 1e-6);
  EXPECT_NEAR(means.at(1, 0, 0)->z, 0.8 / std::sqrt(0.73), 1e-6);
  const MipTexels lean = leanMoments(map);
  EXPECT_NEAR(lean.at(0, 1, 0)[0].x, -0.75, 1e-6);
  EXPECT_NEAR(lean.at(0, 0, 0)[0].z, 0.5625, 1e-6);
  EXPECT_NEAR(lean.at(1, 0, 0)[0].z, 0.375 * 0.375, 1e-6);
  EXPECT_NEAR(lean.at(1, 0, 0)[1].x, 0, 1e-7);
}

class MixtureCache : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(GLINTMARK_BINARY_DIR) / "mixture_cache_test";
    fs::remove_all(folder_);
    setenv("GLINTMARK_CACHE_DIR", folder_.c_str(), 1);
  }
  void TearDown() override { fs::remove_all(folder_); }

  CachedMixtures get(const MixtureOptions& options = {}) {
    return cachedNormalMixtures(map_, options, DiskCache::fromEnvironment());
  }
  fs::path onlyEntry() {
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
    return fs::directory_iterator(folder_)->path();
  }

  fs::path folder_;
  NormalMap map_ = generateNormalMap({.kind = "bumps", .size_px = 16});
};

TEST_F(MixtureCache, GivesTheFitBack) {
  const CachedMixtures first = get(), second = get({.threads = 1});
  EXPECT_FALSE(first.from_cache);
  EXPECT_TRUE(second.from_cache);
  ASSERT_EQ(first.mixtures.moments.texels.size(), second.mixtures.moments.texels.size());
  EXPECT_EQ(mixtureBytes(first.mixtures), mixtureBytes(second.mixtures));
  EXPECT_FALSE(get({.lobes = 3}).from_cache);
  map_.normals[7] = {0.6f, 0, 0.8f};
  EXPECT_FALSE(get().from_cache) << "another map";
}

TEST_F(MixtureCache, RefitsWhatIsDamaged) {
  const std::string good = mixtureBytes(get().mixtures);
  const fs::path entry = onlyEntry();
  fs::resize_file(entry, fs::file_size(entry) / 2);
  EXPECT_FALSE(get().from_cache) << "truncated";
  EXPECT_TRUE(get().from_cache) << "stored again";
  std::fstream file(entry, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(-5, std::ios::end);
  file.put('\x7f');
  file.close();
  EXPECT_FALSE(get().from_cache) << "damaged";

  EXPECT_TRUE(mixturesFromBytes(good));
  EXPECT_FALSE(mixturesFromBytes(good.substr(0, good.size() - 1)));
  EXPECT_FALSE(mixturesFromBytes(good + "x"));
  EXPECT_FALSE(mixturesFromBytes(""));
  std::string other_version = good;
  ++other_version[0];
  EXPECT_FALSE(mixturesFromBytes(other_version));
}

TEST_F(MixtureCache, EveryWrongBitIsFittedAgain) {
  const std::string good = mixtureBytes(get().mixtures);
  const fs::path entry = onlyEntry();
  std::ifstream file(entry, std::ios::binary);
  const std::string stored(std::istreambuf_iterator<char>(file), {});
  const DiskCache cache = DiskCache::fromEnvironment();
  const std::string key = mixtureKey(map_, {});
  ASSERT_TRUE(loadMixtures(cache, key));
  withEachBitFlipped(stored, stored.size() - good.size() + 64, good.size() / 200,
                     [&](const std::string& damaged, const std::string& place) {
                       std::ofstream(entry, std::ios::binary) << damaged;
                       EXPECT_FALSE(loadMixtures(cache, key)) << place;
                     });
  EXPECT_FALSE(get().from_cache);
  EXPECT_EQ(mixtureBytes(get().mixtures).size(), good.size());
}

TEST(MixtureFile, EveryWrongBitIsRefused) {
  const NormalMap map = generateNormalMap({.kind = "bumps", .size_px = 16});
  const std::string good = serializeMixtures(fitNormalMixtures(map));
  ASSERT_NO_THROW(parseMixtures(good, "some.mixtures"));
  withEachBitFlipped(good, 128, good.size() / 400,
                     [&](const std::string& damaged, const std::string& place) {
                       try {
                         parseMixtures(damaged, "some.mixtures");
                         FAIL() << place;
                       } catch (const Error& error) {
                         EXPECT_EQ(std::string(error.what()).rfind("'some.mixtures'", 0), 0u);
                       }
                     });
}

}  // namespace
}  // namespace glintmark
