// White furnaces by the shading kernels: no more light leaves than came in.
#include <gtest/gtest.h>

#include <cmath>

#include "host/frame/white_furnace.h"
#include "host/reference/microfacet.h"
#include "tests/fit/hemisphere_integral.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

/// The furnace's sum over 4096 directions, and the polynomials of the model.
constexpr double kFurnaceTolerance = 3e-3;
/// The same where the lobe is cut off by the horizon, which the directions' rule does not resolve.
constexpr double kMirrorTolerance = 4e-3;

Material clay(DiffuseModel model, double alpha, double masking = 0) {
  Material material;
  material.name = "clay";
  material.has_glints = false;
  material.params.surface.alpha_g = material.params.glints.alpha_l = {0.5f, 0.5f};
  material.params.surface.albedo = {1, 1, 1, 0};
  material.params.surface.intensity = 0;
  material.diffuse_model = model;
  material.diffuse_roughness = alpha;
  material.diffuse_masking = masking;
  return material;
}

Material mirrorMaterial(double alpha, Compensation compensation, float f0 = 1) {
  Material material;
  material.name = "mirror";
  material.has_glints = false;
  const auto a = static_cast<float>(alpha);
  material.params.surface.alpha_g = material.params.glints.alpha_l = {a, a};
  material.params.surface.f0 = {f0, f0, f0, 0};
  material.params.surface.intensity = 1;
  material.compensation = compensation;
  return material;
}

TEST(WhiteFurnace, LambertAndEonLoseNothing) {
  Device& device = testBench().device;
  for (const DiffuseModel model : {DiffuseModel::kLambert, DiffuseModel::kEon})
    for (const double alpha : {0.0, 0.3, 1.0})
      for (const double mu : {0.01, 0.3, 1.0})
        EXPECT_NEAR(whiteFurnace(device, clay(model, alpha), mu), 1, kFurnaceTolerance)
            << alpha << " " << mu;
}

TEST(WhiteFurnace, LobesNeverShineBrighterThanTheirLight) {
  Device& device = testBench().device;
  for (const DiffuseModel model : {DiffuseModel::kPublished, DiffuseModel::kRefit})
    for (const double alpha : {0.0, 0.08, 0.24, 0.5, 0.8, 1.0})
      for (const double masking : {0.0, 1.0})
        for (const double mu : {0.005, 0.05, 0.3, 1.0}) {
          const double radiance = whiteFurnace(device, clay(model, alpha, masking), mu);
          EXPECT_LE(radiance, 1 + kFurnaceTolerance) << alpha << " " << mu;
          EXPECT_GE(radiance, 0.7) << alpha << " " << mu;
        }
}

// The rule over a lobe's quantiles against an adaptive integral over directions.
TEST(WhiteFurnace, MirrorsAlbedoIsTheIntegralOverDirections) {
  for (const double alpha : {0.2, 0.6, 1.0})
    for (const double mu : {0.1, 0.5, 0.9}) {
      const glm::dvec3 view(std::sqrt(1 - mu * mu), 0, mu);
      const double integral = integrateDirections(
          [&](const glm::dvec3& light) {
            return reference::microfacetTimesCosine(reference::Ndf::kBeckmann, light, view, alpha);
          },
          0, 1, 1e-5);
      EXPECT_NEAR(reference::microfacetAlbedo(reference::Ndf::kBeckmann, mu, alpha), integral, 5e-4)
          << alpha << " " << mu;
    }
}

TEST(WhiteFurnace, AMirrorLosesWhatItsLobeLoses) {
  Device& device = testBench().device;
  for (const double alpha : {0.05, 0.24, 0.5, 1.0})
    for (const double mu : {0.05, 0.2, 0.6, 1.0})
      EXPECT_NEAR(whiteFurnace(device, mirrorMaterial(alpha, Compensation::kOff), mu),
                  reference::microfacetAlbedo(reference::Ndf::kBeckmann, mu, alpha,
                                              reference::SmithForm::kRational),
                  kMirrorTolerance)
          << alpha << " " << mu;
}

TEST(WhiteFurnace, ACompensatedMirrorLosesNothing) {
  Device& device = testBench().device;
  for (const double alpha : {0.02, 0.05, 0.1, 0.24, 0.5, 0.77, 1.0})
    for (const double mu : {0.02, 0.05, 0.1, 0.2, 0.4, 0.7, 1.0})
      EXPECT_NEAR(whiteFurnace(device, mirrorMaterial(alpha, Compensation::kLobe), mu), 1,
                  kMirrorTolerance)
          << alpha << " " << mu;
}

// Simulated surfaces reflect up to 0.04 more by one bounce than Smith's lobe, and that is missing.
TEST(WhiteFurnace, AMirrorByTheSimulatedTableLosesAtMostTheSimulationsExcess) {
  Device& device = testBench().device;
  for (const double alpha : {0.1, 0.5, 1.0})
    for (const double mu : {0.1, 0.4, 1.0}) {
      const double radiance =
          whiteFurnace(device, mirrorMaterial(alpha, Compensation::kSimulated), mu);
      EXPECT_GE(radiance, 0.95) << alpha << " " << mu;
      EXPECT_LE(radiance, 1 + kMirrorTolerance) << alpha << " " << mu;
    }
}

TEST(WhiteFurnace, CompensationIsInProportionToReflectance) {
  Device& device = testBench().device;
  const auto gain = [&](float f0) {
    return whiteFurnace(device, mirrorMaterial(0.8, Compensation::kLobe, f0), 0.7) /
               whiteFurnace(device, mirrorMaterial(0.8, Compensation::kOff, f0), 0.7) -
           1;
  };
  EXPECT_NEAR(gain(0.5f), 0.5 * gain(1), 1e-3);
  EXPECT_EQ(gain(0), 0);
}

}  // namespace
}  // namespace glintmark
