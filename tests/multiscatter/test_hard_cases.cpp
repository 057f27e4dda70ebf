// The kernels' models over dense grids of roughness, incidence, view and albedo, also where the
// formulas have nothing to say.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>

#include "host/fit/multiscatter_data.h"
#include "host/frame/multiscatter.h"
#include "host/verify/pixel_harness.h"

namespace glintmark {
namespace {

constexpr double kPi = std::numbers::pi;
/// Relative to a Lambertian lobe's radiance: single precision and the polynomials in a cosine.
constexpr double kModelTolerance = 5e-4;
/// With masking, which on smooth surfaces sets in within cosines of the size of their roughness:
/// polynomials do not follow that, and are off by part of the two hundredths that the published
/// lobes hold there.
constexpr double kMaskedTolerance = 3e-3;
/// Below this cosine of the view mu^(eta - 1) no longer grows in the kernels.
constexpr double kLeastComparedCosine = 0.02;
/// Below this cosine of the light the kernels' masking no longer falls.
constexpr double kLeastLightCosine = 1e-6;

struct DirectionPair {
  glm::dvec3 light, view;
};

struct Radiance {
  double single, multiple;
};

glm::dvec3 direction(double cosine, double azimuth) {
  const double sine = std::sqrt(1 - cosine * cosine);
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), cosine};
}

std::vector<DirectionPair> denseDirections() {
  std::vector<double> cosines = {0, 1e-7, 1e-4, 0.01, 0.02, 0.05};
  for (int i = 1; i <= 20; ++i) cosines.push_back(i / 20.0);
  std::vector<DirectionPair> pairs;
  for (const double in : cosines)
    for (const double out : cosines)
      for (const double azimuth : {0.0, 1.0, kPi / 2, 2.5, kPi})
        pairs.push_back({direction(in, 0), direction(out, azimuth)});
  return pairs;
}

std::string probeOptions(const KernelConfig& config, const std::string& path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  // The caches look at the kernel folder only; the text's hash makes them see changes here.
  return fmt::format("{} -D PROBE_SOURCE={}u", buildOptions(config),
                     static_cast<std::uint32_t>(std::hash<std::string>()(text.str())));
}

// What the kernels make of the pairs, colours of `albedo` included.
std::vector<Radiance> probe(const std::vector<DirectionPair>& pairs, const Material& material,
                            int width, bool masking_compiled_in = false) {
  KernelBench& bench = KernelBench::shared();
  KernelConfig config;
  config.width = width;
  config.glint = false;
  config.diffuse = true;
  config.multiscatter = static_cast<Multiscatter>(material.diffuse_model);
  config.lobe_masking = masking_compiled_in || material.diffuse_masking > 0;
  const std::size_t n = (pairs.size() + 15) / 16 * 16;
  std::vector<float> in(6 * n), out(2 * n);
  for (std::size_t i = 0; i < n; ++i) {
    const DirectionPair& pair = pairs[std::min(i, pairs.size() - 1)];
    for (int k = 0; k < 3; ++k) {
      in[static_cast<std::size_t>(k) * n + i] = static_cast<float>(pair.light[k]);
      in[static_cast<std::size_t>(k + 3) * n + i] = static_cast<float>(pair.view[k]);
    }
  }
  const MultiscatterMaterial prepared = prepareMultiscatter(material, config);
  Buffer input(bench.device, in.size() * 4, "directions");
  Buffer scatter(bench.device, sizeof prepared, "a material's scattering");
  Buffer output(bench.device, out.size() * 4, "radiance");
  input.write(in.data(), in.size() * 4);
  scatter.write(&prepared, sizeof prepared);
  const std::string path = GLINTMARK_SOURCE_DIR "/tests/multiscatter/scatter_probe.cl";
  bench.cache.getWithOptions(path, probeOptions(config, path))
      .kernel("probeScatter")
      .launch(std::vector<KernelArg>{input, scatter, output, static_cast<std::uint32_t>(n)},
              n / static_cast<std::size_t>(width), 16);
  output.read(out.data(), out.size() * 4);
  std::vector<Radiance> result;
  for (std::size_t i = 0; i < pairs.size(); ++i)
    result.push_back({out[i] * prepared.single.x, out[n + i] * prepared.multiple.x});
  return result;
}

Material roughMaterial(DiffuseModel model, double alpha, double albedo, double masking = 0) {
  Material material;
  const auto a = static_cast<float>(albedo);
  material.glint.albedo = {a, a, a, 0};
  material.diffuse_model = model;
  material.diffuse_roughness = alpha;
  material.diffuse_masking = masking;
  return material;
}

// Radiance over irradiance at normal incidence, in double precision.
double expectedRadiance(const Material& material, const LobeModel& lobes, const DirectionPair& d) {
  const double albedo = material.glint.albedo.x;
  if (material.diffuse_model != DiffuseModel::kEon)
    return lobes.energy(albedo, d.light.z, d.view.z) / d.view.z * d.light.z;
  const double r = multiscatterData().eon.at(material.diffuse_roughness);
  const EonValue value = eonBrdf(d.light, d.view, r, albedo);
  return (value.single + value.multiple) * d.light.z;
}

class EveryModel : public ::testing::TestWithParam<DiffuseModel> {};

TEST_P(EveryModel, IsFiniteNotNegativeAndAsInDoublePrecision) {
  const std::vector<DirectionPair> pairs = denseDirections();
  for (const double alpha : {0.0, 1e-3, 0.04, 0.08, 0.12, 0.2, 0.3, 0.45, 0.6, 0.75, 0.9, 1.0})
    for (const double albedo : {0.0, 0.5, 1.0})
      for (const double masking : {0.0, 0.5, 1.0}) {
        if (GetParam() == DiffuseModel::kEon && masking > 0) continue;
        const Material material = roughMaterial(GetParam(), alpha, albedo, masking);
        LobePolynomials set =
            GetParam() == DiffuseModel::kPublished ? kPublishedCode : multiscatterData().refit;
        set.masking = masking;
        const LobeModel lobes(set, material.diffuse_roughness);
        const double tolerance = masking > 0 ? kMaskedTolerance : kModelTolerance;
        const std::vector<Radiance> probed = probe(pairs, material, 16);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
          const std::string where = fmt::format("alpha {} albedo {} masking {} in {} out {}", alpha,
                                                albedo, masking, pairs[i].light.z, pairs[i].view.z);
          const double sum = probed[i].single + probed[i].multiple;
          ASSERT_TRUE(std::isfinite(sum)) << where;
          ASSERT_GE(probed[i].single, 0) << where;
          ASSERT_GE(probed[i].multiple, 0) << where;
          if (albedo == 0) {
            ASSERT_EQ(sum, 0) << where;
          }
          // One albedo is enough for the comparison: it is a factor per order.
          if (albedo != 0.5 || pairs[i].view.z < kLeastComparedCosine ||
              (pairs[i].light.z > 0 && pairs[i].light.z < kLeastLightCosine))
            continue;
          ASSERT_NEAR(sum, expectedRadiance(material, lobes, pairs[i]),
                      tolerance * std::max(pairs[i].light.z, sum))
              << where;
        }
      }
}

TEST_P(EveryModel, EveryWidthGivesTheSameBits) {
  const std::vector<DirectionPair> pairs = denseDirections();
  const double masking = GetParam() == DiffuseModel::kEon ? 0 : 0.7;
  const Material material = roughMaterial(GetParam(), 0.6, 0.8, masking);
  const auto one = probe(pairs, material, 1);
  for (const int width : {4, 8, 16}) {
    const auto wide = probe(pairs, material, width);
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      ASSERT_EQ(one[i].single, wide[i].single) << width;
      ASSERT_EQ(one[i].multiple, wide[i].multiple) << width;
    }
  }
}

TEST(Masking, OfNoImportanceChangesNoBit) {
  const std::vector<DirectionPair> pairs = denseDirections();
  const Material material = roughMaterial(DiffuseModel::kRefit, 0.7, 0.8);
  const auto without = probe(pairs, material, 16), with = probe(pairs, material, 16, true);
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    ASSERT_EQ(without[i].single, with[i].single);
    ASSERT_EQ(without[i].multiple, with[i].multiple);
  }
}

TEST(Masking, DarkensGrazingLobes) {
  const std::vector<DirectionPair> grazing = {{direction(0.1, 0), direction(0.1, 2)}};
  const auto multiple = [&](double masking) {
    return probe(grazing, roughMaterial(DiffuseModel::kRefit, 1, 1, masking), 16)[0].multiple;
  };
  const double g = smithMasking(0.1, 1);
  // [PAT18] "Analytical Lobe Expression"; nothing is cut off here.
  EXPECT_NEAR(multiple(0.5) / multiple(0), 0.5 + 0.5 * g * g, 2e-3);
  EXPECT_NEAR(multiple(1) / multiple(0), g * g, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(Models, EveryModel,
                         ::testing::Values(DiffuseModel::kPublished, DiffuseModel::kRefit,
                                           DiffuseModel::kEon));

// [PAT18] "Example Code", written anew from the blog with its own digits: the lobe's intensity,
// which is 2 pi times the energy per solid angle.
double patapomIntensity(double mu, double mu_out, double r, double albedo) {
  const double scale =
      0.028813261153483097 - 0.9215374811620882 * r + 6.632726114385572 * std::pow(r, 2) -
      4.5957022306534 * std::pow(r, 3) +
      mu * (-0.09663259042197028 + 7.214143602200921 * r - 19.786845117100626 * std::pow(r, 2) +
            11.042058883797509 * std::pow(r, 3)) +
      std::pow(mu, 2) * (0.10935692546815767 - 10.790405157520944 * r +
                         28.50803667636733 * std::pow(r, 2) - 15.665258273262731 * std::pow(r, 3)) +
      std::pow(mu, 3) * (-0.04376425480146207 + 5.2491960091879 * r -
                         13.582707339717146 * std::pow(r, 2) + 7.348408854602616 * std::pow(r, 3));
  const double eta = 2.588380909161985 * r - 1.3549594389004276 * r * r;
  const double flat =
      0.8850557867448499 - 1.2109761138443194 * r + 0.22569832413951335 * r * r +
      0.4498256199595464 * r * r * r + mu * (0.0856807009397115 + 0.5659031384072539 * r) +
      mu * mu * (-0.07707463071513312 - 1.384614678037336 * r + 0.8565888280926491 * r * r) +
      mu * mu * mu * (0.010423083821992304 + 0.8525591060832015 * r - 0.6844738691665317 * r * r);
  const double l = 1 / std::sqrt(1 + mu_out * mu_out * (1 / (flat * flat) - 1));
  const double intensity = (eta + 2) * std::pow(mu_out, eta) / kPi;
  return l * intensity * albedo * albedo * (scale + albedo * 0.363902052363025 * scale);
}

TEST(PublishedModel, IsTheBlogsCodeWhereThatIsNotNegativeAndTheFurnaceHasRoom) {
  const std::vector<DirectionPair> pairs = denseDirections();
  int compared = 0;
  for (const double alpha : {0.08, 0.24, 0.5, 0.8, 1.0})
    for (const double albedo : {0.5, 1.0}) {
      const Material material = roughMaterial(DiffuseModel::kPublished, alpha, albedo);
      const LobeModel model(kPublishedCode, alpha);
      const std::vector<Radiance> probed = probe(pairs, material, 16);
      for (std::size_t i = 0; i < pairs.size(); ++i) {
        const double in = pairs[i].light.z, out = pairs[i].view.z;
        if (out < kLeastComparedCosine) continue;
        const double blog = patapomIntensity(in, out, alpha, albedo);
        const double expected = std::max(blog, 0.0) / (2 * kPi * out) * in;
        EXPECT_LE(probed[i].multiple, expected * (1 + kModelTolerance) + 1e-6);
        const double eta = lobeAt(kPublishedCode, 1, alpha).exponent;
        const double furnace = model.means(out).plain * std::pow(out, eta - 1);
        if (furnace > 0.99 * model.scattered()) continue;
        EXPECT_NEAR(probed[i].multiple, expected, kModelTolerance * expected + 1e-6)
            << alpha << " " << in << " " << out;
        ++compared;
      }
    }
  EXPECT_GT(compared, 2000);
}

TEST(PublishedModel, TextAndCodeHaveTheSameScale) {
  // The digits that the blog's text prints.
  const double text[4][4] = {{0.02881326115, -0.92153748116, 6.63272611438, -4.595702230},
                             {-0.09663259042, 7.21414360220, -19.7868451171, 11.04205888},
                             {0.10935692546, -10.7904051575, 28.5080366763, -15.66525827},
                             {-0.04376425480, 5.24919600918, -13.5827073397, 7.348408854}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      EXPECT_NEAR(kPublishedCode.scale[i][j], text[i][j], 1e-8) << i << " " << j;
}

}  // namespace
}  // namespace glintmark
