// Which cells a pixel visits: how many, against brute force over all cells of a grid.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/harness/pixel_harness.h"
#include "host/harness/random_pixels.h"
#include "host/reference/footprint.h"
#include "tests/print_names.h"
#include "tests/shared_bench.h"

namespace glintmark {
namespace {

using reference::GridVisit;

HandMadeFrame frameOf(std::vector<HandMadePixel> pixels) {
  HandMadeFrame frame;
  frame.pixels = std::move(pixels);
  for (HandMadePixel& pixel : frame.pixels) pixel.frame = flatFrame();
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.05f, 0.05f}, 1e6f);
  frame.lights = {coneLight({0.1, 0, 1})};
  return frame;
}

ShadedPixels visit(const HandMadeFrame& frame, GlintMethod method, int ka = 16) {
  KernelConfig config;
  config.width = 16;
  config.method = method;
  config.ka = ka;
  config.size_variation = false;
  config.count_cells = true;
  return shadePixels(testBench(), frame, config);
}

TEST(CellsZk16, SquareFootprintsTakeFewAndLongOnesTheLimit) {
  for (const double aspect : {1.0, 16.0, 64.0}) {
    std::vector<HandMadePixel> pixels(256);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      auto& f = pixels[i].footprint;
      f.u = fixedCoordinate(0.0613 * static_cast<double>(i));
      f.v = fixedCoordinate(0.0271 * static_cast<double>(i));
      const double size = std::exp2(-8 - static_cast<double>(i) / 256);
      f.duv_dx = {size * aspect, 0};
      f.duv_dy = {0, size};
    }
    const ShadedPixels shaded = visit(frameOf(std::move(pixels)), GlintMethod::kZk16);
    const auto limited = std::ranges::count(shaded.limited, true);
    const std::uint32_t most = *std::ranges::max_element(shaded.cells);
    if (aspect == 1) {
      EXPECT_LE(most, 12u);
      EXPECT_EQ(limited, 0);
    } else {
      EXPECT_EQ(most, 64u);
      EXPECT_GT(limited, 128);
    }
  }
}

TEST(CellsZk16, LowerLimitsVisitFewerCells) {
  const HandMadeFrame frame = frameOf(randomPixels(2000, {1e-4, 1e-2, 64}));
  for (const int ka : {1, 4, 64}) {
    const ShadedPixels shaded = visit(frame, GlintMethod::kZk16, ka);
    EXPECT_LE(*std::ranges::max_element(shaded.cells),
              static_cast<std::uint32_t>(4 * std::max(ka, 2)));
    EXPECT_GE(*std::ranges::min_element(shaded.cells), 4u);
  }
}

// A grid's weight of one cell, found by sampling the parallelogram.
double sampledCoverage(const reference::GridFootprint& grid, std::int64_t u, std::int64_t v) {
  constexpr int kSteps = 200;
  int inside = 0;
  for (int j = 0; j < kSteps; ++j)
    for (int i = 0; i < kSteps; ++i) {
      const glm::dvec2 p = grid.centre + grid.edge_x * ((i + 0.5) / kSteps - 0.5) +
                           grid.edge_y * ((j + 0.5) / kSteps - 0.5);
      inside += grid.base_u + static_cast<std::int64_t>(std::floor(p.x)) == u &&
                grid.base_v + static_cast<std::int64_t>(std::floor(p.y)) == v;
    }
  const double area = std::abs(grid.edge_x.x * grid.edge_y.y - grid.edge_x.y * grid.edge_y.x);
  return area * inside / (kSteps * kSteps);
}

TEST(CellsExact, ReferenceWeightsAreSharedAreas) {
  // The reference's polygon clipping, itself, against sampling.
  for (const HandMadePixel& pixel : randomPixels(20, {1e-3, 1e-2, 12})) {
    const auto grids = reference::visitExact(pixel.footprint, {glm::dvec2(1), -30});
    for (const GridVisit& visit : grids) {
      const auto grid = reference::inGrid(pixel.footprint, {1, 1}, visit.level);
      const double area = std::abs(grid.edge_x.x * grid.edge_y.y - grid.edge_x.y * grid.edge_y.x);
      double sum = 0;
      for (const reference::Cell& cell : visit.cells) sum += cell.weight;
      EXPECT_NEAR(sum / area, 1, 1e-4) << "cells that share less than 1e-6 are left out";
      const reference::Cell& cell = visit.cells[visit.cells.size() / 2];
      EXPECT_NEAR(cell.weight, sampledCoverage(grid, cell.u, cell.v), 0.02 * std::max(area, 1.0));
    }
  }
}

TEST(CellsExact, ReferenceFindsEveryTouchedCell) {
  for (const HandMadePixel& pixel : randomPixels(200, {1e-3, 1e-2, 12})) {
    for (const GridVisit& visit : reference::visitExact(pixel.footprint, {{0.5, 1}, -30})) {
      const auto grid = reference::inGrid(pixel.footprint, {0.5, 1}, visit.level);
      // Every sample's cell is in the list, but for corners of less than 1e-6.
      int missing = 0;
      for (int s = 0; s < 400; ++s) {
        const double a = std::fmod(s * 0.6180339887, 1.0) - 0.5, b = (s + 0.5) / 400 - 0.5;
        const glm::dvec2 p = grid.centre + grid.edge_x * a + grid.edge_y * b;
        const std::int64_t u = grid.base_u + static_cast<std::int64_t>(std::floor(p.x));
        const std::int64_t v = grid.base_v + static_cast<std::int64_t>(std::floor(p.y));
        missing += std::ranges::none_of(
            visit.cells, [&](const reference::Cell& cell) { return cell.u == u && cell.v == v; });
      }
      EXPECT_EQ(missing, 0);
    }
  }
}

TEST(CellsExact, TurningByARightAngleKeepsTheCount) {
  std::vector<HandMadePixel> pixels = randomPixels(2000, {1e-3, 1e-2, 30});
  const ShadedPixels straight = visit(frameOf(pixels), GlintMethod::kExact);
  for (HandMadePixel& pixel : pixels) {
    std::swap(pixel.footprint.u, pixel.footprint.v);
    // The protocol's offsets differ between the axes by whole cells.
    for (glm::dvec2* d : {&pixel.footprint.duv_dx, &pixel.footprint.duv_dy}) std::swap(d->x, d->y);
  }
  const ShadedPixels turned = visit(frameOf(pixels), GlintMethod::kExact);
  std::size_t different = 0;
  for (std::size_t i = 0; i < straight.cells.size(); ++i)
    different += straight.cells[i] != turned.cells[i];
  EXPECT_LE(different, 10u) << "of 2000: areas at the threshold of 1e-6";
}

// --- Stability -----------------------------------------------------------------------------------

// An image of glints on a plane, one pixel 1 / 64 uv wide, the camera moved by `shift_px`.
std::vector<double> planeImage(GlintMethod method, glm::dvec2 shift_px, double zoom, int samples) {
  constexpr int kSize = 128;
  HandMadeFrame frame;
  const double pixel_uv = zoom * 0.0137 / samples;
  const int fine = kSize * samples;
  for (int y = 0; y < fine; ++y)
    for (int x = 0; x < fine; ++x) {
      HandMadePixel pixel;
      pixel.frame = flatFrame();
      const double px = (x + 0.5) / samples + shift_px.x, py = (y + 0.5) / samples + shift_px.y;
      // Turned by 0.3 rad against the grid.
      const double c = std::cos(0.3), s = std::sin(0.3), scale = pixel_uv * samples;
      pixel.footprint.u = fixedCoordinate(scale * (c * px - s * py));
      pixel.footprint.v = fixedCoordinate(scale * (s * px + c * py));
      pixel.footprint.duv_dx = {c * pixel_uv, s * pixel_uv};
      pixel.footprint.duv_dy = {-s * pixel_uv, c * pixel_uv};
      frame.pixels.push_back(pixel);
    }
  frame.material = simpleMaterial({0.3f, 0.3f}, {0.15f, 0.15f}, 2e5f);
  frame.lights = {coneLight({0.1, 0, 1})};
  KernelConfig config;
  config.width = 16;
  config.method = method;
  config.size_variation = false;
  const ShadedPixels shaded = shadePixels(testBench(), frame, config);
  std::vector<double> image(kSize * kSize);
  for (int y = 0; y < fine; ++y)
    for (int x = 0; x < fine; ++x) {
      const int pixel = y / samples * kSize + x / samples, sample = y * fine + x;
      image[static_cast<std::size_t>(pixel)] +=
          shaded.radiance[static_cast<std::size_t>(sample)].x / (samples * samples);
    }
  return image;
}

// Mean squared change relative to that between unrelated images: 0 for the same image, 1 for two
// with nothing in common but their statistics.
double change(const std::vector<double>& a, const std::vector<double>& b) {
  double mean_a = 0, mean_b = 0, difference = 0, variance = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    mean_a += a[i] / static_cast<double>(a.size());
    mean_b += b[i] / static_cast<double>(a.size());
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double da = a[i] - mean_a, db = b[i] - mean_b;
    difference += (da - db) * (da - db);
    variance += da * da + db * db;
  }
  return difference / variance;
}

class Stability : public testing::TestWithParam<GlintMethod> {};

TEST_P(Stability, SubPixelMotionChangesNoMoreThanSupersampling) {
  // Averaging 4 x 4 samples of each pixel gives an image that moves smoothly. Shading the pixel
  // once must flicker no more. 128 x 128 pixels know `change` to about 0.01.
  constexpr double kStandardErrors = 0.03;
  for (const glm::dvec2& shift :
       {glm::dvec2(0.125, 0), glm::dvec2(0.25, 0.1), glm::dvec2(0.5, 0.5)}) {
    const double once =
        change(planeImage(GetParam(), {0, 0}, 1, 1), planeImage(GetParam(), shift, 1, 1));
    const double supersampled =
        change(planeImage(GetParam(), {0, 0}, 1, 4), planeImage(GetParam(), shift, 1, 4));
    std::printf("shift (%.3f, %.3f) px: change %.3f, supersampled %.3f\n", shift.x, shift.y, once,
                supersampled);
    EXPECT_LT(once, supersampled + kStandardErrors);
    EXPECT_GT(once, 0);
  }
}

TEST_P(Stability, ZoomingChangesTheImageSmoothly) {
  // Across a change of grid level (0.0137 uv lies between 2^-7 and 2^-6) by small steps. The image
  // scales about its corner, so that the far pixels move by up to 0.6 px a step.
  for (double zoom = 1.0; zoom < 1.3; zoom *= 1.06) {
    const double once = change(planeImage(GetParam(), {0, 0}, zoom, 1),
                               planeImage(GetParam(), {0, 0}, zoom * 1.005, 1));
    const double supersampled = change(planeImage(GetParam(), {0, 0}, zoom, 4),
                                       planeImage(GetParam(), {0, 0}, zoom * 1.005, 4));
    EXPECT_LT(once, supersampled + 0.03) << zoom;
  }
}

// Radiance of pixels that are each exactly one cell of grid `level`, cells (i, j) for i, j below
// `count`, with `per_cell` microdetails in each.
std::vector<float> cellImage(GlintMethod method, int level, int count, double per_cell) {
  const double size = std::ldexp(1.0, level);
  HandMadeFrame frame;
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      HandMadePixel pixel;
      pixel.frame = flatFrame();
      pixel.footprint.u = fixedCoordinate((i + 0.5) * size);
      pixel.footprint.v = fixedCoordinate((j + 0.5) * size);
      pixel.footprint.duv_dx = {size, 0};
      pixel.footprint.duv_dy = {0, size};
      frame.pixels.push_back(pixel);
    }
  frame.material =
      simpleMaterial({0.3f, 0.3f}, {0.1f, 0.1f}, static_cast<float>(per_cell / (size * size)));
  frame.lights = {coneLight({0.1, 0, 1})};
  KernelConfig config;
  config.width = 16;
  config.method = method;
  config.size_variation = false;
  std::vector<float> image;
  for (const glm::vec3& radiance : shadePixels(testBench(), frame, config).radiance)
    image.push_back(radiance.x);
  return image;
}

TEST_P(Stability, ZoomingByTwoKeepsHalfOfTheSeeds) {
  // [ZK16] Fig. 4: along each axis every second cell of the finer grid draws what the coarser
  // grid's cell at the same place draws; the others have nothing to do with it.
  constexpr int kCount = 64;
  const std::vector<float> fine = cellImage(GetParam(), -8, 2 * kCount, 1000);
  const std::vector<float> coarse = cellImage(GetParam(), -7, kCount, 1000);
  int kept[2][2] = {};
  for (int j = 0; j < 2 * kCount; ++j)
    for (int i = 0; i < 2 * kCount; ++i) {
      const int small = j * 2 * kCount + i, large = j / 2 * kCount + i / 2;
      kept[j % 2][i % 2] +=
          fine[static_cast<std::size_t>(small)] == coarse[static_cast<std::size_t>(large)];
    }
  EXPECT_EQ(kept[0][0], kCount * kCount);
  // Binomials of mean 100 agree by chance in 3 % of the cells.
  for (const int other : {kept[0][1], kept[1][0], kept[1][1]})
    EXPECT_LT(other, 0.1 * kCount * kCount);
}

INSTANTIATE_TEST_SUITE_P(Methods, Stability,
                         testing::Values(GlintMethod::kZk16, GlintMethod::kExact),
                         [](const auto& method) {
                           return method.param == GlintMethod::kZk16 ? "zk16" : "exact";
                         });

}  // namespace
}  // namespace glintmark
