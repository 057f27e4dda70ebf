// Whole frames by every method: lanes, limits, hard maps, and what absent switches leave behind.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <stdio.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "host/filter/normal_map_generators.h"
#include "host/frame/effect/normal_maps.h"
#include "host/frame/effects.h"
#include "host/frame/frame_renderer.h"
#include "host/frame/ground_truth.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/small_scenes.h"
#include "host/mixture/normal_mixture.h"
#include "host/report/metrics.h"
#include "tests/print_names.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

constexpr int kSize_px = 48;
/// Where a pixel is much smaller than a texel nothing is averaged, and all methods show the base
/// lobe around the interpolated normal; what is left is the variance between texels (not of gmm),
/// the difference of cos^n and Beckmann (fournier) and of slopes and normals (lean). Relative to
/// the mean radiance.
constexpr double kMagnifiedTolerance = 0.02;
constexpr double kExactTolerance = 2e-3;
/// Halves keep a lobe's weight, mean and deviation to 2^-11.
constexpr double kHalfTolerance = 5e-3;
constexpr int kTruthSpp = 64;

constexpr NormalMethod kAllMethods[] = {NormalMethod::kMip,         NormalMethod::kFixed,
                                        NormalMethod::kToksvig,     NormalMethod::kLean,
                                        NormalMethod::kFournier,    NormalMethod::kGmm,
                                        NormalMethod::kVmf,         NormalMethod::kVmfLobes,
                                        NormalMethod::kAnisotropic, NormalMethod::kLeadr};

struct MappedFloor {
  Scene scene;
  View view = lookingDown(60, 3);
  ShadingOptions options;
  std::shared_ptr<NormalTextures> textures = std::make_shared<NormalTextures>(testBench().device);

  explicit MappedFloor(NormalMap map) : scene(mappedFloor(std::move(map))) {
    options.width_px = options.height_px = kSize_px;
  }

  Image render(NormalMethod method, int lanes = 0, bool half = false) const {
    ShadingOptions chosen = options;
    chosen.normal_method = method;
    chosen.lanes = lanes;
    chosen.half_texels = half;
    FrameRenderer renderer(testBench().device, scene, view, chosen, 1, textures);
    renderer.prepare();
    renderer.shade();
    return renderer.readRadiance();
  }
  TruthImages truth() const {
    return renderTruth(testBench().device, scene, view, options, kTruthSpp, {}, 1, textures);
  }
};

NormalMap bumps(int size_px) {
  return generateNormalMap({.kind = "bumps", .size_px = size_px, .seed = 3});
}

// Mean of the absolute differences over the mean of the reference.
double relativeDifference(const Image& image, const Image& reference) {
  double sum = 0, total = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    sum += std::abs(static_cast<double>(image.pixels[i]) - reference.pixels[i]);
    total += reference.pixels[i];
  }
  return sum / total;
}

class Methods : public testing::TestWithParam<NormalMethod> {};

TEST_P(Methods, OneLaneAndSixteenGiveTheSameBits) {
  const MappedFloor floor(bumps(64));
  EXPECT_EQ(floor.render(GetParam(), 1).pixels, floor.render(GetParam(), 16).pixels);
}

TEST_P(Methods, MagnifiedMapsAgreeWithTheTruth) {
  MappedFloor floor(bumps(32));
  floor.view = lookingDown(60, 0.05);
  const TruthImages truth = floor.truth();
  EXPECT_LT(relativeDifference(floor.render(GetParam()), truth.mean), kMagnifiedTolerance);
}

TEST_P(Methods, HardMapsStayFinite) {
  NormalMap strip = bumps(16), lone = bumps(1), odd = bumps(37), steep = bumps(16);
  strip.height_px = 1;
  strip.normals.resize(16);
  for (std::size_t i = 0; i < steep.normals.size(); ++i)
    steep.normals[i] = glm::normalize(glm::vec3(i % 2 == 0 ? 1 : -1, i % 3 == 0 ? 1 : 0, 1e-3f));
  for (const NormalMap& map : {strip, lone, odd, steep, generateNormalMap({"flat", 4})})
    for (const double distance : {0.5, 6.0}) {
      MappedFloor floor(map);
      floor.view = lookingDown(8, distance);
      const Image image = floor.render(GetParam());
      EXPECT_TRUE(isSane(image)) << map.width_px << "x" << map.height_px << " " << map.name;
    }
}

TEST_P(Methods, FlatMapsAreTheMeshItself) {
  MappedFloor mapped(generateNormalMap({"flat", 8}));
  MappedFloor bare = mapped;
  bare.scene.materials[0].normal_map.reset();
  EXPECT_LT(relativeDifference(mapped.render(GetParam()), bare.render(GetParam())),
            GetParam() == NormalMethod::kFournier ? kMagnifiedTolerance : kExactTolerance);
}

INSTANTIATE_TEST_SUITE_P(All, Methods, testing::ValuesIn(kAllMethods));

TEST(Mixtures, HalvesDoNotCancel) {
  const MappedFloor floor(bumps(64));
  const Image whole = floor.render(NormalMethod::kGmm);
  EXPECT_LT(relativeDifference(floor.render(NormalMethod::kGmm, 0, true), whole), kHalfTolerance);
}

// Where a pixel holds several texels; nearer, LEAN's one Gaussian of slopes is as close
// (docs/normal_filtering.md).
TEST(Mixtures, AreNearerToTheTruthThanOtherFilters) {
  MappedFloor floor(generateNormalMap({.kind = "disk", .size_px = 128}));
  floor.view = lookingDown(60, 6.5);
  const Image truth = floor.truth().mean;
  const double gmm = relativeDifference(floor.render(NormalMethod::kGmm), truth);
  for (const NormalMethod method :
       {NormalMethod::kMip, NormalMethod::kFixed, NormalMethod::kToksvig, NormalMethod::kLean})
    EXPECT_LT(gmm, relativeDifference(floor.render(method), truth)) << static_cast<int>(method);
}

TEST(Truth, BatchesAddUpToTheSameSamples) {
  MappedFloor floor(bumps(32));
  const auto render = [&](std::initializer_list<std::uint32_t> counts) {
    TruthRenderer renderer(testBench().device, floor.scene, floor.view, floor.options, 1,
                           floor.textures);
    renderer.prepare();
    std::uint32_t done = 0;
    for (const std::uint32_t count : counts) {
      renderer.addSamples(done, count);
      done += count;
    }
    return renderer.readSum();
  };
  EXPECT_LT(relativeDifference(render({5, 11}), render({16})), 1e-6);
}

// Root mean square over the red of all covered pixels.
template <typename Value>
double rootMeanSquare(const TruthImages& truth, const Value& value) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < truth.mean.pixels.size() / 4; ++i)
    if (truth.mean.pixels[4 * i + 3] > 0) {
      const double one = value(i);
      sum += one * one;
      ++count;
    }
  return std::sqrt(sum / count);
}

// Samples lie evenly, so their own spread says several times too much: only that of replicates says
// how far the truth is from one that is known much better.
TEST(Truth, StandardErrorIsTheDistanceToAFinerTruth) {
  const MappedFloor floor(bumps(64));
  const auto render = [&](int spp) {
    return renderTruth(testBench().device, floor.scene, floor.view, floor.options, spp, {}, 1,
                       floor.textures);
  };
  const TruthImages fine = render(8192);
  for (const int spp : {16, 64, 256}) {
    const TruthImages coarse = render(spp);
    const double stated = rootMeanSquare(
                     coarse, [&](std::size_t i) { return coarse.standard_error.pixels[3 * i]; }),
                 actual = rootMeanSquare(coarse, [&](std::size_t i) {
                   return coarse.mean.pixels[4 * i] - fine.mean.pixels[4 * i];
                 });
    EXPECT_GT(stated / actual, 0.5) << spp;
    EXPECT_LT(stated / actual, 2) << spp;
  }
}

TEST(Truth, ReplicatesAreSharedOutAndOneSampleStatesNoError) {
  const MappedFloor floor(bumps(32));
  const auto replicates = [&](int spp, TruthImages& truth) {
    std::vector<Image> means;
    std::vector<int> done;
    truth = renderTruth(
        testBench().device, floor.scene, floor.view, floor.options, spp,
        [&](int samples) { done.push_back(samples); }, 1, floor.textures, &means);
    EXPECT_EQ(done.back(), spp);
    return means;
  };
  TruthImages truth;
  EXPECT_EQ(replicates(1, truth).size(), 1u);
  EXPECT_EQ(
      rootMeanSquare(truth, [&](std::size_t i) { return truth.standard_error.pixels[3 * i]; }), 0);
  EXPECT_EQ(replicates(5, truth).size(), 5u);
  // Ten samples: two replicates of two, six of one.
  const std::vector<Image> means = replicates(10, truth);
  ASSERT_EQ(means.size(), 8u);
  Image mean = truth.mean;
  for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
    double sum = 0;
    for (std::size_t r = 0; r < means.size(); ++r) sum += (r < 2 ? 2 : 1) * means[r].pixels[i];
    mean.pixels[i] = static_cast<float>(sum / 10);
  }
  EXPECT_LT(relativeDifference(truth.mean, mean), 1e-5);
  EXPECT_GT(relativeDifference(means[0], means[1]), 1e-3) << "the same points twice";
}

// shade.cl after the preprocessor.
std::string preprocessed(KernelConfig config) {
  config.planes = PlaneMask::all();
  const std::string command = fmt::format("g++ -E -P -x c -I '{0}' {1} '{0}/shade.cl' 2>&1",
                                          kernelFolder(), buildOptions(config));
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string text;
  char chunk[4096];
  while (pipe && fgets(chunk, sizeof chunk, pipe.get())) text += chunk;
  return text;
}

TEST(Mixtures, AbsentNormalMapsLeaveNothingBehind) {
  KernelConfig config;
  config.glint = config.size_variation = false;
  config.normal_map = true;
  config.normal_method = NormalMethod::kGmm;
  config.lobes = 4;
  const std::string with = preprocessed(config);
  config.normal_map = false;
  config.normal_method = NormalMethod::kMip;
  config.lobes = 1;
  const std::string without = preprocessed(config);
  for (const char* name : {"footprintProbes", "fetchTexels4", "lobeFromMoments", "evaluateShape"}) {
    EXPECT_NE(with.find(name), std::string::npos) << name << " was renamed";
    EXPECT_EQ(without.find(name), std::string::npos) << name;
  }
  for (const Plane plane : {Plane::kUFrac, Plane::kDudx}) {
    EXPECT_FALSE(planesFor(config).has(plane));
  }
}

// Lobes that no normal of a texel has are tiny numbers in a fit; on Intel's processors sums of such
// numbers take a hundred cycles each.
TEST(Mixtures, TexelsHoldNothingNearDenormals) {
  const auto tiny = [](const auto& texels) {
    return std::ranges::count_if(texels, [](const float4& t) {
      return (t.x != 0 && std::abs(t.x) < 1e-20f) || (t.w != 0 && std::abs(t.w) < 1e-20f);
    });
  };
  const MappedFloor floor(generateNormalMap({.kind = "disk", .size_px = 64}));
  const auto& map = floor.scene.materials[0].normal_map->map;
  EXPECT_GT(
      tiny(fitNormalMixtures(*map, mixtureOptions(4, MixtureOrder::kColours, 0)).moments.texels), 0)
      << "a fit has none: this test says nothing";
  KernelConfig config;
  config.normal_method = NormalMethod::kGmm;
  config.lobes = 4;
  const NormalTexture& texture = floor.textures->get(map, config);
  std::vector<float4> texels(texture.texels.bytes() / sizeof(float4));
  texture.texels.read(texels.data(), texture.texels.bytes());
  EXPECT_EQ(tiny(texels), 0);
}

TEST(Mixtures, OnlyTheChosenTextureIsMade) {
  const MappedFloor floor(bumps(16));
  floor.render(NormalMethod::kToksvig);
  const std::size_t means = floor.textures->bytes();
  EXPECT_EQ(means, (16u * 16 + 8 * 8 + 4 * 4 + 2 * 2 + 1) * sizeof(float4));
  floor.render(NormalMethod::kMip);
  EXPECT_EQ(floor.textures->bytes(), means) << "mip reads the same texture";
}

}  // namespace
}  // namespace glintmark
