// Tables of anisotropic lobes: what they hold, how they are looked up, what their files say.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>

#include "host/core/error.h"
#include "host/fit/anisotropic_lobe.h"
#include "host/fit/anisotropic_table.h"
#include "host/reference/ltc.h"

namespace glintmark {
namespace {

using reference::Ndf;

std::string messageOfTable(const std::string& bytes) {
  try {
    parseAnisotropicTable(bytes, "some.table");
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(AnisotropicTable, NodesAreLookedUpAndFiled) {
  AnisotropicTable table;
  table.ndf = Ndf::kBeckmann;
  for (int i = 0; i < ANISO_CELLS; ++i) {
    AnisotropicCell cell;
    cell.rest[1][2] = i;
    cell.albedo = -i;
    cell.schlick_albedo = 2.0 * i;
    table.setCell(i, cell);
  }
  for (const AnisotropicNode& node : {AnisotropicNode{1, 1, 0, 0}, {3, 7, 2, 5}, {7, 7, 7, 7}}) {
    const int index = anisotropicIndex(node);
    const AnisotropicCell found = lookUpAnisotropic(table, anisotropicView(table.ndf, node));
    EXPECT_NEAR(found.rest[1][2], index, 1e-6 * ANISO_CELLS);
    EXPECT_NEAR(found.albedo, -index, 1e-6 * ANISO_CELLS);
    EXPECT_NEAR(found.schlick_albedo, 2 * index, 2e-6 * ANISO_CELLS);
  }
  const AnisotropicTable back = parseAnisotropicTable(serializeAnisotropicTable(table), "back");
  EXPECT_EQ(back.ndf, table.ndf);
  EXPECT_EQ(back.values, table.values);
  const std::vector<float> padded = table.paddedValues();
  ASSERT_EQ(padded.size(), std::size_t{ANISO_CELLS} * ANISO_STRIDE);
  EXPECT_EQ(padded[5 * ANISO_STRIDE + ANISO_ALBEDO], -5);
}

TEST(AnisotropicTable, FilesSayWhatIsWrong) {
  const std::string good = serializeAnisotropicTable(AnisotropicTable{});
  EXPECT_EQ(messageOfTable(good), "");
  EXPECT_NE(messageOfTable("").find("some.table is not an anisotropic LTC table; `glintmark fit "
                                    "ltc --anisotropic` writes one"),
            std::string::npos);
  std::string other = good;
  other[8] = 1;
  EXPECT_NE(messageOfTable(other).find("of version 1 with 12 floats per cell, expected version 2"),
            std::string::npos);
  EXPECT_NE(messageOfTable(good.substr(0, good.size() - 4)).find("for a table of 8x8x8x8"),
            std::string::npos);
  other = good;
  other[40] ^= 1;
  EXPECT_NE(messageOfTable(other).find("checksum"), std::string::npos);
  try {
    loadAnisotropicTable("/no/such/place.table");
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no anisotropic LTC table /no/such/place.table"),
              std::string::npos);
  }
}

// A matrix may be scaled and turned about its z: what is stored is the same lobe.
TEST(AnisotropicTable, CellsHoldTheLobe) {
  const AnisotropicView view{
      .ndf = Ndf::kGgx, .alpha = {0.5, 0.1}, .cos_theta = 0.6, .phi_rad = 0.8};
  const glm::dmat3 matrix(1.0, 0.3, 0.1, -0.1, 0.4, 0.2, -0.7, 0.1, 0.8);
  const double c = std::cos(1.1), s = std::sin(1.1);
  const glm::dmat3 turned =
      3.0 * glm::dmat3(c * matrix[0] + s * matrix[1], c * matrix[1] - s * matrix[0], matrix[2]);
  AnisotropicCell cell, same;
  storeAnisotropic(matrix, view, cell);
  storeAnisotropic(turned, view, same);
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      EXPECT_NEAR(cell.rest[column][row], same.rest[column][row], 1e-12);
  const glm::dmat3 inverse = glm::inverse(anisotropicMatrix(cell, view));
  for (const glm::dvec3& d : {glm::dvec3(0, 0, 1), {-0.6, 0.3, 0.7}, {0.5, -0.5, 0.4}})
    EXPECT_NEAR(reference::ltcDensity(inverse, d), reference::ltcDensity(glm::inverse(matrix), d),
                1e-12);
}

// The samples' integral against facets drawn from the NDF, and the fit against its start.
TEST(AnisotropicLobe, FitsBetterThanItStarts) {
  const AnisotropicView view{
      .ndf = Ndf::kGgx, .alpha = {0.4, 0.1}, .cos_theta = 0.7, .phi_rad = 0.5};
  const glm::dmat3 start = glm::inverse(anisotropicMatrix(AnisotropicCell{}, view));
  const glm::dmat3 found = fitAnisotropicLobe(view, {&start, 1});
  const AnisotropicSamples samples = makeAnisotropicSamples(view, found, {96, 128, 64, 96, 24, 48});
  EXPECT_LT(anisotropicError(samples, found), 0.75 * anisotropicError(samples, start));
  EXPECT_LT(anisotropicError(samples, found), 0.3);
  double albedo = 0;
  constexpr int kSteps = 200;
  const glm::dvec3 o = view.toSurface(view.view());
  for (int i = 0; i < kSteps; ++i)
    for (int j = 0; j < kSteps; ++j) {
      const double u = (i + 0.5) / kSteps, turn = 2 * std::numbers::pi * (j + 0.5) / kSteps;
      const double slope = std::sqrt(u / (1 - u));
      const glm::dvec3 m = glm::normalize(glm::dvec3(view.alpha.x * slope * std::cos(turn),
                                                     view.alpha.y * slope * std::sin(turn), 1));
      const double facing = glm::dot(o, m);
      if (facing <= 0) continue;
      albedo += reference::microfacetTimesCosine(view.ndf, 2 * facing * m - o, o, view.alpha) * 4 *
                facing /
                (reference::microfacetDensity(view.ndf, m, view.alpha) * m.z * kSteps * kSteps);
    }
  EXPECT_NEAR(samples.albedo, albedo, 2e-3);
}

TEST(AnisotropicTable, ShippedOnesAreOfTheirNdf) {
  for (const Ndf ndf : {Ndf::kGgx, Ndf::kBeckmann}) {
    const AnisotropicTable table = shippedAnisotropicTable(ndf);
    EXPECT_EQ(table.ndf, ndf);
    // Rough and round, seen straight down: nearly all is reflected of what is not masked.
    const AnisotropicCell cell = table.cell(anisotropicIndex({2, 7, 0, 0}));
    EXPECT_NEAR(cell.albedo, 1, 0.02);
  }
}

}  // namespace
}  // namespace glintmark
