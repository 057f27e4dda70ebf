// The fit, and the tables that ship: against their own refit, against quadrature, against the
// published table where it is at hand.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <vector>

#include "host/core/error.h"
#include "host/fit/ltc_error.h"
#include "host/fit/ltc_fit.h"
#include "host/fit/ltc_lobe.h"
#include "host/fit/ltc_objective.h"
#include "host/fit/minimize.h"
#include "host/reference/ltc.h"
#include "host/reference/polygon_light.h"
#include "tests/fit/hemisphere_integral.h"
#include "tests/print_names.h"

namespace glintmark {
namespace {

using reference::Ndf;

// A refit starts elsewhere and stops elsewhere in the same flat minimum: its error may be this
// much lower or higher, in units of the integral.
constexpr double kRefitError = 3e-3;
// Albedos by cubature over some 12000 directions, of lobes as narrow as 1e-4.
constexpr double kAlbedoError = 2e-3;
// Single precision in the file.
constexpr double kStored = 1e-6;
// ltcCellError promises one percent.
constexpr double kErrorOfErrors = 0.01;

glm::dvec3 viewAt(double cosine) {
  return {std::sqrt(1 - cosine * cosine), 0, cosine};
}

TEST(Minimize, FindsTheBottomOfAValley) {
  const auto rosenbrock = [](const std::array<double, 2>& x, std::array<double, 2>& gradient) {
    const double a = 1 - x[0], b = x[1] - x[0] * x[0];
    gradient = {-2 * a - 40 * x[0] * b, 20 * b};
    return a * a + 10 * b * b;
  };
  const Minimum<2> found =
      minimize<2>(rosenbrock, {-1.2, 1}, {.iterations = 200, .least_gain = 1e-15});
  EXPECT_NEAR(found.at[0], 1, 1e-5);
  EXPECT_NEAR(found.at[1], 1, 1e-5);
}

TEST(Minimize, NeverWorseThanTheStart) {
  // A gradient that points the wrong way: no step gains anything.
  const auto misled = [](const std::array<double, 1>& x, std::array<double, 1>& gradient) {
    gradient = {-2 * x[0]};
    return x[0] * x[0];
  };
  const Minimum<1> found = minimize<1>(misled, {0.5});
  EXPECT_EQ(found.at[0], 0.5);
  EXPECT_EQ(found.value, 0.25);
}

TEST(Minimize, TheFirstStepIsNoLongerThanTheUnit) {
  std::vector<double> visited;
  const auto parabola = [&](const std::array<double, 1>& x, std::array<double, 1>& gradient) {
    visited.push_back(x[0]);
    gradient = {20 * x[0]};
    return 10 * x[0] * x[0];
  };
  const Minimum<1> found = minimize<1>(parabola, {3}, {.unit = 0.1});
  EXPECT_NEAR(found.at[0], 0, 1e-4);
  const auto step = std::ranges::find_if(visited, [](double x) { return x != 3; });
  ASSERT_NE(step, visited.end());
  EXPECT_NEAR(*step, 2.9, 1e-9);
}

TEST(LtcObjective, DerivativesAreThoseOfTheValue) {
  const LtcLobe lobe{std::log(0.3), std::log(0.2), 0.2, -0.9};
  const LtcSamples samples = makeLtcSamples(Ndf::kGgx, 0.2, 0.5, lobe);
  std::array<double, 4> gradient{}, unused{};
  ltcFitError(samples, lobe, gradient);
  const auto moved = [&](int k, double by) {
    LtcLobe other = lobe;
    (k == 0   ? other.log_width_x
     : k == 1 ? other.log_width_y
     : k == 2 ? other.shear
              : other.tilt_rad) += by;
    return ltcFitError(samples, other, unused);
  };
  constexpr double kStep = 1e-6;
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(gradient[k], (moved(k, kStep) - moved(k, -kStep)) / (2 * kStep), 1e-5) << k;
  }
}

TEST(LtcLobe, MatrixAndLobeAreInverses) {
  const LtcLobe lobe{std::log(0.3), std::log(0.2), -0.4, -0.9};
  const LtcLobe back = lobeOfMatrix(3.0 * ltcInverseMatrix(lobe));
  EXPECT_NEAR(back.log_width_x, lobe.log_width_x, 1e-12);
  EXPECT_NEAR(back.log_width_y, lobe.log_width_y, 1e-12);
  EXPECT_NEAR(back.shear, lobe.shear, 1e-12);
  EXPECT_NEAR(back.tilt_rad, lobe.tilt_rad, 1e-12);
}

TEST(LtcLobe, StoredInTheMirrorsFrameAndTurnedBack) {
  const LtcLobe lobe{std::log(0.03), std::log(0.02), 0.3, -0.9};
  LtcCell cell;
  storeLobe(lobe, 0.01, 0.6, cell);
  const glm::dmat3 expected = ltcInverseMatrix(lobe), got = ltcInverseMatrix(cell, 0.01, 0.6);
  for (int column = 0; column < 3; ++column) {
    EXPECT_LT(glm::length(expected[column] - got[column]), 1e-12);
  }
}

class ShippedTable : public testing::TestWithParam<Ndf> {
 protected:
  const LtcTable table_ = shippedLtcTable(GetParam());
};

TEST_P(ShippedTable, RefitOfSampleCellsReproducesIt) {
  for (const auto& [x, y] : {std::pair{5, 20}, {16, 0}, {20, 40}, {31, 55}, {45, 10}, {60, 61}}) {
    const double alpha = ltcFitAlpha(x, table_.size), cosine = ltcRowCosine(y, table_.size);
    // From a start of its own: the mirror's lobe, fitted on its own samples and then on the fit's.
    LtcLobe lobe = mirrorLobe(alpha, cosine);
    for (int pass = 0; pass < 3; ++pass) {
      lobe = fitLtcLobe(GetParam(), alpha, cosine, {&lobe, 1}, y == 0);
    }
    LtcCell refit = table_.cell(x, y);
    storeLobe(lobe, alpha, cosine, refit);
    refit.scale = refit.albedo / reference::ltcMassAboveHorizon(ltcInverseMatrix(lobe));
    const double error = ltcCellError(GetParam(), refit, alpha, cosine);
    const double shipped = ltcCellError(GetParam(), table_.cell(x, y), alpha, cosine);
    EXPECT_NEAR(shipped, error, kRefitError) << x << " " << y;
    // Directions and widths agree as well, in units of the width.
    const LtcLobe stored = lobeOfMatrix(ltcInverseMatrix(table_.cell(x, y), alpha, cosine));
    const double width = std::exp(lobe.log_width_x);
    EXPECT_NEAR((stored.tilt_rad - lobe.tilt_rad) / std::min(width, 1.0), 0, 0.1) << x << " " << y;
    EXPECT_NEAR(stored.log_width_x, lobe.log_width_x, 0.1) << x << " " << y;
    EXPECT_NEAR(stored.log_width_y, lobe.log_width_y, 0.1) << x << " " << y;
  }
}

TEST_P(ShippedTable, AlbedosAgreeWithQuadrature) {
  for (const auto& [x, y] : {std::pair{20, 10}, {30, 50}, {40, 63}, {63, 0}, {63, 40}}) {
    const double alpha = ltcFitAlpha(x, table_.size);
    const glm::dvec3 view = viewAt(ltcRowCosine(y, table_.size));
    const auto brdf = [&](const glm::dvec3& i) {
      return reference::microfacetTimesCosine(GetParam(), i, view, alpha);
    };
    const auto schlick = [&](const glm::dvec3& i) {
      return brdf(i) * std::pow(1 - glm::dot(glm::normalize(i + view), view), 5);
    };
    const LtcCell cell = table_.cell(x, y);
    EXPECT_NEAR(cell.albedo, integrateDirections(brdf, 0, 1, 1e-5), kAlbedoError) << x << " " << y;
    EXPECT_NEAR(cell.schlick_albedo, integrateDirections(schlick, 0, 1, 1e-5), kAlbedoError)
        << x << " " << y;
  }
}

TEST_P(ShippedTable, WhiteFurnaceNeverGainsEnergy) {
  constexpr double kLow = 1e-13;  // the narrowest lobe at the horizon is 1e-10 high
  const std::vector<glm::dvec3> sky = {{-1, -1, kLow}, {1, -1, kLow}, {1, 1, kLow}, {-1, 1, kLow}};
  for (int y = 0; y < table_.size; y += 3) {
    for (int x = 0; x < table_.size; x += 3) {
      const LtcCell cell = table_.cell(x, y);
      const glm::dmat3 inverse =
          ltcInverseMatrix(cell, ltcFitAlpha(x, table_.size), ltcRowCosine(y, table_.size));
      const double share = reference::ltcOverPolygon(inverse, sky);
      EXPECT_LE(cell.albedo, 1 + kStored);
      EXPECT_GT(cell.albedo, 0.2);
      EXPECT_GE(cell.schlick, 0);
      EXPECT_LE(cell.schlick, cell.scale);
      EXPECT_NEAR(cell.scale * share, cell.albedo, 1e-5) << x << " " << y;
      EXPECT_NEAR(cell.schlick * share, cell.schlick_albedo, 1e-5) << x << " " << y;
    }
  }
}

TEST_P(ShippedTable, ErrorsAreWhatQuadratureSays) {
  for (const auto& [x, y] : {std::pair{25, 20}, {40, 45}, {55, 60}}) {
    const double alpha = ltcFitAlpha(x, table_.size), cosine = ltcRowCosine(y, table_.size);
    const LtcCell cell = table_.cell(x, y);
    const glm::dmat3 inverse = ltcInverseMatrix(cell, alpha, cosine);
    const double expected = integrateDirections(
        [&](const glm::dvec3& i) {
          return std::abs(cell.scale * reference::ltcDensity(inverse, i) -
                          reference::microfacetTimesCosine(GetParam(), i, viewAt(cosine), alpha));
        },
        0, 1, 1e-4);
    EXPECT_NEAR(ltcCellError(GetParam(), cell, alpha, cosine), expected,
                kErrorOfErrors * expected + 1e-4)
        << x << " " << y;
  }
}

// Interpolation between nodes must not cost more than the fit itself does; see docs/ltc_fit.md.
TEST_P(ShippedTable, BetweenNodesTheErrorIsThatOfTheNodes) {
  for (const auto& [x, y] : {std::pair{1, 30}, {2, 58}, {10, 40}, {30, 50}, {50, 20}}) {
    const double root_x = (x + 0.5) / 63, root_y = (y + 0.5) / 63;
    const double alpha = root_x * root_x, cosine = 1 - root_y * root_y;
    const auto node = [&](int at_x, int at_y) {
      return ltcCellError(GetParam(), table_.cell(at_x, at_y), ltcFitAlpha(at_x, 64),
                          ltcRowCosine(at_y, 64));
    };
    const double nodes = (node(x, y) + node(x + 1, y) + node(x, y + 1) + node(x + 1, y + 1)) / 4;
    EXPECT_LT(ltcCellError(GetParam(), lookUpLtc(table_, alpha, cosine), alpha, cosine),
              1.05 * nodes + 2e-3)
        << x << " " << y;
  }
}

INSTANTIATE_TEST_SUITE_P(Ndfs, ShippedTable, testing::Values(Ndf::kGgx, Ndf::kBeckmann),
                         [](const auto& test) { return reference::ndfName(test.param); });

TEST(LtcFit, BitsDoNotDependOnThreads) {
  const LtcTable one = fitLtcTable({.size = 8, .threads = 1, .progress = {}});
  const LtcTable three = fitLtcTable({.size = 8, .threads = 3, .progress = {}});
  EXPECT_EQ(one.values, three.values);
}

TEST(LtcFit, ReportsProgressUpToTheEnd) {
  double last = 0;
  fitLtcTable({.size = 8, .threads = 2, .progress = [&](double share) {
                 EXPECT_GT(share, last);
                 last = share;
               }});
  EXPECT_EQ(last, 1);
}

TEST(LtcFit, RefusesSizes) {
  EXPECT_THROW(fitLtcTable({.size = 7, .progress = {}}), Error);
  EXPECT_THROW(fitLtcTable({.size = 129, .progress = {}}), Error);
}

// GLINTMARK_PUBLISHED_LTC: path of the ltc.mat that accompanies [HH16].
TEST(LtcFit, NoWorseThanThePublishedTable) {
  const char* path = std::getenv("GLINTMARK_PUBLISHED_LTC");
  if (path == nullptr) GTEST_SKIP() << "GLINTMARK_PUBLISHED_LTC does not name the published table";
  const LtcErrors theirs = ltcNodeErrors(readPublishedLtc(path));
  const LtcErrors ours = ltcNodeErrors(shippedLtcTable(Ndf::kGgx));
  EXPECT_LT(ours.mean(), 0.75 * theirs.mean());
  EXPECT_LT(ours.max(), theirs.max());
}

// Our own table in the layout of ltc.mat stands in for the published one, which is not everywhere:
// M, not its inverse, column by column, and magnitudes.
TEST(PublishedLtc, ATableInItsLayoutIsReadBack) {
  const LtcTable ours = shippedLtcTable(Ndf::kGgx);
  std::string text;
  const auto add = [&](const std::string& name, const std::function<double(int, int)>& value) {
    text += "# name: " + name + "\n# type: matrix\n# rows: 64\n# columns: 64\n";
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) text += fmt::format(" {:.17g}", value(x, y));
      text += "\n";
    }
  };
  const auto inverseAt = [&](int x, int y) {
    return ltcInverseMatrix(ours.cell(x, y), ltcFitAlpha(x, 64), ltcRowCosine(y, 64));
  };
  add("tabMagnitude", [&](int x, int y) { return ours.cell(x, y).albedo; });
  for (int column = 0; column < 3; ++column)
    for (int row = 0; row < 3; ++row)
      add(fmt::format("tab{}{}", column, row),
          [&](int x, int y) { return glm::inverse(inverseAt(x, y))[column][row]; });
  const auto path =
      std::filesystem::temp_directory_path() / fmt::format("glintmark_ltc_{}.mat", ::getpid());
  std::ofstream(path) << text;
  const LtcTable read = readPublishedLtc(path);
  std::filesystem::remove(path);
  for (const auto& [x, y] : {std::pair{0, 0}, {5, 60}, {20, 33}, {63, 0}, {40, 63}, {63, 63}}) {
    const LtcCell cell = read.cell(x, y);
    EXPECT_NEAR(cell.albedo, ours.cell(x, y).albedo, 1e-6) << x << " " << y;
    const glm::dmat3 want = inverseAt(x, y),
                     got = ltcInverseMatrix(cell, ltcFitAlpha(x, 64), ltcRowCosine(y, 64));
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        EXPECT_NEAR(got[i][j], want[i][j], 1e-5 * (1 + std::abs(want[i][j]))) << x << " " << y;
    if (y == 63) continue;
    EXPECT_NEAR(ltcCellError(Ndf::kGgx, cell, ltcFitAlpha(x, 64), ltcRowCosine(y, 64)),
                ltcCellError(Ndf::kGgx, ours.cell(x, y), ltcFitAlpha(x, 64), ltcRowCosine(y, 64)),
                0.05)
        << x << " " << y;
  }
}

TEST(PublishedLtc, OtherFilesAreRefused) {
  EXPECT_THROW(readPublishedLtc("/no/such/ltc.mat"), Error);
}

}  // namespace
}  // namespace glintmark
