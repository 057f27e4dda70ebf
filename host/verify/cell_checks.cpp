// Which cells pixels visit, how many they pay for, and the same bits at every lane count.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/harness/probes.h"
#include "host/harness/tolerances.h"
#include "host/verify/check_groups.h"
#include "host/verify/draw_case.h"

namespace glintmark {
namespace {

// So many random footprints of the case, all seen along the normal.
HandMadeFrame seenFromAbove(const DrawCase& c, int pixels) {
  HandMadeFrame frame = drawFrame(c);
  frame.pixels = randomPixels(pixels, c.footprints);
  for (HandMadePixel& pixel : frame.pixels) pixel.frame = flatFrame();
  frame.ray_origin = {0, 0, -1};
  frame.ray_dx = frame.ray_dy = glm::dvec3(0);
  return frame;
}

reference::GridRules rulesOf(const DrawCase& c) {
  return reference::gridRules({c.alpha_g.x, c.alpha_g.y}, {c.alpha_l.x, c.alpha_l.y}, c.density);
}

// A footprint as the planes hold it: derivatives are floats.
reference::PixelFootprint asStored(reference::PixelFootprint footprint) {
  for (glm::dvec2* d : {&footprint.duv_dx, &footprint.duv_dy}) *d = glm::dvec2(glm::vec2(*d));
  return footprint;
}

// [ZK16] Sect. 5: from 8 to 64 cells at K_a = 16, half of them in either grid. Footprints up to
// beyond the limit, of any size; those of which cells of the finest grid are wider than the pixel
// know that grid alone.
Finding cellRange(const CheckContext& context) {
  const DrawCase c = {"", GlintMethod::kZk16, {.3f, .3f}, {.05f, .05f}, 1e6f, 0, false,
                      16, {1e-5, 1, 200}};
  const HandMadeFrame frame = seenFromAbove(c, 20000);
  const ShadedPixels shaded = drawPixels(context, c, frame);
  const double finest = std::exp2(rulesOf(c).finest_level);
  Finding finding(0);
  double outside = 0;
  std::uint32_t least_of_two = 64, most_of_one = 0;
  for (std::size_t i = 0; i < shaded.cells.size(); ++i) {
    const std::uint32_t cells = shaded.cells[i];
    const bool alone = reference::cellSizeZk16(asStored(frame.pixels[i].footprint), c.ka) < finest;
    outside += alone ? cells < 4 || cells > 32 || cells % 2 != 0
                     : cells < 8 || cells > 64 || cells % 2 != 0;
    if (alone) most_of_one = std::max(most_of_one, cells);
    if (!alone) least_of_two = std::min(least_of_two, cells);
  }
  finding.add(outside);
  const auto [least, most] = std::ranges::minmax(shaded.cells);
  finding.require(least == 4 && most == 64, fmt::format("{} to {} cells", least, most));
  finding.require(
      least_of_two == 8 && most_of_one == 32,
      fmt::format("{} at least in two grids, {} at most in one", least_of_two, most_of_one));
  return finding;
}

// Cells paid for, by brute force over the steps of both grids: lanes side by side walk each grid as
// long as the longest of them does, two steps of two cells at a time.
Finding paidCells(const CheckContext& context) {
  const DrawCase c = {"", GlintMethod::kZk16, {.3f, .3f}, {.05f, .05f}, 1e6f, 0, false,
                      16, {1e-4, 1e-2, 200}};
  const HandMadeFrame frame = seenFromAbove(c, 4096);
  const ShadedPixels shaded = drawPixels(context, c, frame);
  const reference::GridRules rules = rulesOf(c);
  const auto lanes = static_cast<std::size_t>(context.lanes);
  Finding finding(0);
  double different = 0, visited = 0, paid = 0;
  for (std::size_t first = 0; first < shaded.cells.size(); first += lanes) {
    std::size_t most[2] = {0, 0};
    for (std::size_t i = first; i < first + lanes; ++i) {
      const auto grids = reference::visitZk16(asStored(frame.pixels[i].footprint), rules, c.ka);
      for (int g = 0; g < 2; ++g) most[g] = std::max(most[g], grids[g].cells.size());
    }
    for (std::size_t i = first; i < first + lanes; ++i) {
      different += shaded.paid[i] != (most[0] + 3) / 4 * 4 + (most[1] + 3) / 4 * 4;
      visited += shaded.cells[i];
      paid += shaded.paid[i];
    }
  }
  finding.add(different);
  finding.require(context.lanes == 1 || paid > visited, "idle lanes cost nothing");
  return finding;
}

// The grids that footprints of any size and shape meet: log2 of the cell size, which the finer
// level and the coarser grid's weight add up to, and the stretched box.
Finding footprintLevels(const CheckContext& context) {
  Finding finding(1);
  const glm::dvec2 stretch(0.25, 1);
  GlintMaterial glints{};
  glints.gamma = {0.25f, 1};
  glints.finest_level = -30;
  std::vector<reference::PixelFootprint> footprints;
  for (const HandMadePixel& pixel : randomPixels(5000, {1e-6, 1, 200}))
    footprints.push_back(asStored(pixel.footprint));
  for (const int ka : {1, 16, 64}) {
    const FootprintProbe probed =
        probeFootprints(context.bench, footprints, glints, GlintMethod::kZk16, ka, context.lanes);
    for (std::size_t i = 0; i < footprints.size(); ++i) {
      const reference::PixelFootprint& f = footprints[i];
      finding.add(std::abs(probed.fine_level[i] + probed.coarse_weight[i] -
                           std::log2(reference::cellSizeZk16(f, ka))) /
                  kFootprintLevel);
      const glm::dvec2 box = stretch * glm::max(glm::abs(f.duv_dx), glm::abs(f.duv_dy));
      finding.add(std::abs(probed.extent_u[i] / box.x - 1) / kFootprintExtent);
      finding.add(std::abs(probed.extent_v[i] / box.y - 1) / kFootprintExtent);
      finding.require(probed.coarse_weight[i] >= 0 && probed.coarse_weight[i] <= 1,
                      "weights of grids are from 0 to 1");
    }
  }
  return finding;
}

struct WidthCase {
  const char* name;
  GlintMethod method;
  bool groove, colour, cone;
};
constexpr WidthCase kWidthCases[] = {
    {"zk16", GlintMethod::kZk16, false, false, false},
    {"zk16_groove_colour_cone", GlintMethod::kZk16, true, true, true},
    {"exact", GlintMethod::kExact, false, false, false},
    {"distributed", GlintMethod::kDistributed, false, true, false},
    {"deliot_belcour", GlintMethod::kDeliotBelcour, false, true, true},
    {"deliot_corrected", GlintMethod::kDeliotCorrected, false, false, false},
    {"kemppinen", GlintMethod::kKemppinen, false, true, true},
    {"published_zk16", GlintMethod::kPublishedZk16, false, true, true},
    {"chermain", GlintMethod::kChermain, false, true, true},
    {"chermain_corrected", GlintMethod::kChermainCorrected, true, false, false}};

Finding sameGlints(const CheckContext& context, const WidthCase& c) {
  HandMadeFrame frame;
  frame.pixels = randomPixels(1003, {1e-4, 1e-2, 24});
  frame.material = simpleMaterial({0.3f, 0.2f}, {0.05f, 0.04f}, 1e6f, 1);
  frame.lights = {coneLight({-0.3, 0.2, 0.9}, c.cone ? 0.05 : 0),
                  coneLight({0.4, 0.1, 0.8}, 0, 0.3)};
  setRandomRays(frame);
  KernelConfig config;
  config.width = 1;
  config.method = c.method;
  config.groove = c.groove;
  config.glint_colour = c.colour;
  config.light_cone = c.cone;
  config.count_cells = true;
  const ShadedPixels one = shadePixels(context.bench, frame, config);
  config.width = context.lanes;
  const ShadedPixels wide = shadePixels(context.bench, frame, config);
  double different = 0;
  for (std::size_t i = 0; i < one.cells.size(); ++i)
    different += one.cells[i] != wide.cells[i] || one.limited[i] != wide.limited[i] ||
                 one.radiance[i] != wide.radiance[i];
  Finding finding(0);
  finding.add(different);
  return finding;
}

// The nearer the roughness of a groove along u is to the surface's, the longer it is: how much of
// the contrast is left between pixels 8 apart along u.
double changeAlong(const CheckContext& context, float alpha_lu) {
  const DrawCase c = {"",    GlintMethod::kZk16, {.1f, .5f}, {alpha_lu, .05f}, 1e6f, 0, true, 16,
                      kUsual};
  HandMadeFrame frame = drawFrame(c);
  frame.ray_origin = {0, 0, -1};
  frame.ray_dx = frame.ray_dy = glm::dvec3(0);
  const double side = 1e-3;
  for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
    HandMadePixel& pixel = frame.pixels[i];
    const double pair = static_cast<double>(i / 2);
    pixel.frame = flatFrame();
    pixel.footprint.u = fixedCoordinate(0.0917 * pair + (i % 2 == 0 ? 0 : 8 * side));
    pixel.footprint.v = fixedCoordinate(0.0371 * pair);
    pixel.footprint.duv_dx = {side, 0};
    pixel.footprint.duv_dy = {0, side};
  }
  const ShadedPixels shaded = drawPixels(context, c, frame);
  double change = 0, contrast = 0, mean = 0;
  for (const glm::vec3& radiance : shaded.radiance) mean += radiance.x;
  mean /= static_cast<double>(shaded.radiance.size());
  for (std::size_t i = 0; i + 1 < shaded.radiance.size(); i += 2) {
    change += std::abs(shaded.radiance[i].x - shaded.radiance[i + 1].x);
    contrast += std::abs(shaded.radiance[i].x - mean);
  }
  return change / contrast;
}

Finding grooveLength(const CheckContext& context) {
  Finding finding(0.1);
  finding.add(changeAlong(context, .1f));
  finding.require(changeAlong(context, .01f) > 0.8, "short grooves do not end within 8 pixels");
  return finding;
}

// Where 32 bits of an index come back, 4096 uv further, cells are others; without DEEP_UV they are
// the same.
Finding noRecurrence(const CheckContext& context) {
  DrawCase c = {"", GlintMethod::kZk16, {.3f, .3f}, {.2f, .2f}, 0x1p46f, 0, false, 16, kDeep};
  c.footprints.most_aspect = 1.001;
  const auto ratios = [&](double further_uv, bool deep) {
    HandMadeFrame frame = drawFrame(c);
    frame.ray_origin = {0, 0, -1};
    frame.ray_dx = frame.ray_dy = glm::dvec3(0);
    for (std::size_t i = 0; i < frame.pixels.size(); ++i) {
      HandMadePixel& pixel = frame.pixels[i];
      pixel.frame = flatFrame();
      pixel.footprint.duv_dx = {0x1p-20, 0};
      pixel.footprint.duv_dy = {0, 0x1p-20};
      pixel.footprint.u = fixedCoordinate(5000 + 0.37 * static_cast<double>(i) + further_uv);
    }
    KernelConfig config;
    config.width = context.lanes;
    config.size_variation = false;
    config.deep_uv = deep;
    std::vector<double> values;
    for (const glm::vec3& radiance : shadePixels(context.bench, frame, config).radiance)
      values.push_back(radiance.x);
    return values;
  };
  const auto recurring = [&](bool deep) {
    const std::vector<double> here = ratios(0, deep), there = ratios(4096, deep);
    double same = 0;
    for (std::size_t i = 0; i < here.size(); ++i) same += here[i] == there[i];
    return same / static_cast<double>(here.size());
  };
  Finding finding(kRecurringShare);
  finding.add(recurring(true));
  finding.require(recurring(false) > 0.99, "cells do not come back without DEEP_UV either");
  return finding;
}

}  // namespace

std::vector<Check> cellChecks() {
  std::vector<Check> checks;
  checks.push_back({"cells/footprint", "error in units of its bound", footprintLevels});
  checks.push_back({"cells/zk16_range", "pixels outside 4 to 32 cells a grid", cellRange});
  checks.push_back({"cells/paid", "pixels that pay for other cells", paidCells});
  checks.push_back(
      {"cells/groove_length", "change along a long groove, of the contrast", grooveLength});
  checks.push_back(
      {"cells/no_recurrence", "pixels that are the same 4096 uv further", noRecurrence});
  for (const WidthCase& c : kWidthCases)
    checks.push_back({std::string("cells/same_bits_") + c.name,
                      "pixels that differ from one lane's",
                      [&c](const CheckContext& context) { return sameGlints(context, c); }});
  return checks;
}

}  // namespace glintmark
