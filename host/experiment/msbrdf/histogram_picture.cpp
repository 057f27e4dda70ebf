// Pictures of what a simulation counted.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "host/experiment/msbrdf/lobe_picture.h"
#include "host/report/picture/colour_map.h"
#include "host/report/picture/text_drawing.h"

namespace glintmark {
namespace {

constexpr double kBrightestRays = 200;
constexpr std::size_t kWidestBin = 8;

// Energy per solid angle [1 / sr] of one order and side, in bins of `width` x `width` cells.
struct Density {
  std::size_t width = 1;
  std::vector<double> bins;
  double most = 0;
};

Density density(const Simulation& simulation, int side, int order) {
  Density d;
  for (;; d.width *= 2) {
    const std::size_t columns = HF_AZIMUTHS / d.width;
    d.bins.assign(HF_COSINES / d.width * columns, 0);
    for (std::size_t row = 0; row < HF_COSINES; ++row)
      for (std::size_t column = 0; column < HF_AZIMUTHS; ++column)
        d.bins[row / d.width * columns + column / d.width] +=
            static_cast<double>(simulation.cell(side, order, row, column));
    d.most = *std::ranges::max_element(d.bins);
    if (d.width == kWidestBin || d.most >= kBrightestRays) break;
  }
  const double solid_angle =
      2 * std::numbers::pi / HF_CELLS * static_cast<double>(d.width * d.width);
  const double share =
      1 / (solid_angle * static_cast<double>(std::max<std::uint64_t>(simulation.rays_done, 1)));
  for (double& bin : d.bins) bin *= share;
  d.most *= share;
  return d;
}

LobeDisc orderDisc(const Simulation& simulation, int side, int order) {
  const auto d = std::make_shared<const Density>(density(simulation, side, order));
  LobeDisc disc;
  const double energy = static_cast<double>(simulation.left(side, order)) /
                        static_cast<double>(std::max<std::uint64_t>(simulation.rays_done, 1));
  disc.caption = side == 0 ? fmt::format("order {}: {:.2f} % of the energy", order, 100 * energy)
                           : fmt::format("order {} below: {:.2f} %", order, 100 * energy);
  disc.note = fmt::format("brightest {:.3g} / sr", d->most);
  disc.value = [d](double cosine, double azimuth) {
    const auto row = static_cast<std::size_t>((1 - cosine) * HF_COSINES);
    const auto column = static_cast<std::size_t>(azimuth / (2 * std::numbers::pi) * HF_AZIMUTHS);
    return d
        ->bins[std::min<std::size_t>(row, HF_COSINES - 1) / d->width * (HF_AZIMUTHS / d->width) +
               std::min<std::size_t>(column, HF_AZIMUTHS - 1) / d->width];
  };
  const glm::dvec3 light = incidentDirection(simulation.settings);
  disc.compass = true;
  disc.light_cosine = light.z;
  disc.light_azimuth = std::atan2(light.y, light.x);
  return disc;
}

std::string title(const SimulationSettings& s) {
  constexpr const char* kKinds[] = {"diffuse", "metal", "dielectric"};
  return fmt::format(
      "{}, roughness {:g}{}, light at {:g} degrees", kKinds[static_cast<int>(s.kind)], s.alpha.x,
      s.alpha.x == s.alpha.y ? "" : fmt::format(" x {:g}", s.alpha.y), s.incidence_deg);
}

}  // namespace

Image histogramPicture(const Simulation& simulation) {
  constexpr int kMargin_px = 12, kHeading_px = 32, kLegend_px = 60, kHeader_px = 72;
  constexpr int kBarWidth_px = 120, kBarHeight_px = 10, kGap_px = 8;
  constexpr TextStyle kHeading{.size_px = 20, .weight = TextWeight::kBold};
  constexpr TextStyle kLegend{.size_px = 13, .colour = kSoftInk};
  std::vector<LobeDisc> discs;
  const int sides = simulation.settings.kind == SurfaceKind::kDielectric ? 2 : 1;
  for (int side = 0; side < sides; ++side)
    for (int order = 1; order <= simulation.settings.orders; ++order)
      discs.push_back(orderDisc(simulation, side, order));
  const Image lobes = lobePicture(discs, simulation.settings.orders);

  const std::string heading = title(simulation.settings);
  const std::string from = "0", to = "brightest      rings: 30, 60 degrees      cross: the light";
  const int bar_x = kMargin_px + textWidth(from, kLegend) + kGap_px;
  const int to_x = bar_x + kBarWidth_px + kGap_px;
  Image image(std::max({lobes.width, textWidth(heading, kHeading) + 2 * kMargin_px,
                        to_x + textWidth(to, kLegend) + kMargin_px}),
              lobes.height + kHeader_px, 3);
  fillRect(image, 0, 0, image.width, image.height, kPaper);
  drawText(image, kMargin_px, kHeading_px, heading, kHeading);
  drawText(image, kMargin_px, kLegend_px, from, kLegend);
  for (int i = 0; i < kBarWidth_px; ++i)
    fillRect(image, bar_x + i, kLegend_px - kBarHeight_px, 1, kBarHeight_px,
             falseColour((i + 0.5) / kBarWidth_px));
  drawText(image, to_x, kLegend_px, to, kLegend);
  for (int row = 0; row < lobes.height; ++row)
    for (int column = 0; column < lobes.width; ++column)
      std::ranges::copy(lobes.at(column, row), image.at(column, row + kHeader_px).begin());
  return image;
}

}  // namespace glintmark
