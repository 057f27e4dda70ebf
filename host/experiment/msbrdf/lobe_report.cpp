#include "host/experiment/msbrdf/lobe_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/experiment/msbrdf/lobe_picture.h"
#include "host/report/picture/line_chart.h"
#include "host/report/picture/matrix_picture.h"
#include "host/report/picture/picture_strip.h"
#include "host/report/record/text_table.h"

namespace glintmark {
namespace {

// A set of polynomials under its name.
struct NamedSet {
  const char* name;
  const LobePolynomials* set;
};

std::vector<NamedSet> setsOf(const LobeFits& fits) {
  return {{"PAT18 text", &kPublishedText},
          {"PAT18 code", &kPublishedCode},
          {"refit", &fits.data.refit}};
}

// Energy per solid angle of one order by polynomials.
std::function<double(double, double)> polynomialModel(const LobePolynomials& set,
                                                      const LobeData& data) {
  const Lobe lobe = lobeAt(set, data.mu_in, data.alpha);
  const double order = data.order == 3 ? set.thirdOverSecond(data.alpha) : 1;
  return [lobe, order](double cosine, double) { return order * lobeEnergy(lobe, cosine); };
}

std::function<double(double, double)> freeModel(const FittedLobe& fitted) {
  return [&fitted](double cosine, double azimuth) {
    return freeLobeEnergy(fitted.lobe, fitted.data.alpha, fitted.data.mu_in, cosine, azimuth);
  };
}

std::string fixed(double value) {
  return fmt::format("{:.4f}", value);
}

Image errorMatrices(const LobeFits& fits) {
  std::vector<std::vector<double>> values(4);
  for (std::size_t a = 0; a < fits.alphas.size(); ++a)
    for (std::size_t i = 0; i < fits.incidences_deg.size(); ++i) {
      const FittedLobe& f = fits.at(a, i, 2);
      values[0].push_back(f.lobe.error);
      values[1].push_back(lobeError(f.data, polynomialModel(fits.data.refit, f.data)));
      values[2].push_back(lobeError(f.data, polynomialModel(kPublishedCode, f.data)));
      values[3].push_back(lobeError(f.data, polynomialModel(kPublishedText, f.data)));
    }
  return matrixPicture(
      {{"free lobe", values[0]},
       {"refit", values[1]},
       {"PAT18 code", values[2]},
       {"PAT18 text", values[3]}},
      {.width = static_cast<int>(fits.incidences_deg.size()),
       .height = static_cast<int>(fits.alphas.size()),
       .entry_px = 24,
       .low = 0,
       .high = 1,
       .title = "order 2: root mean square error over the mean",
       .x_label = fmt::format("incidence {} to {} deg", fits.incidences_deg.front(),
                              fits.incidences_deg.back()),
       .y_label =
           fmt::format("roughness {:.2f} to {:.2f}", fits.alphas.front(), fits.alphas.back())});
}

// One lobe cut along the plane of incidence; the light is on the positive side.
ChartPanel lobeSection(const LobeFits& fits, const FittedLobe& f, double incidence_deg) {
  ChartPanel panel{
      fmt::format("roughness {:.2f}, incidence {:.0f} deg", f.data.alpha, incidence_deg),
      {},
      -90,
      90};
  ChartSeries simulated{"simulated", seriesColour(0), {}, {}, true};
  for (const int column : {LobeData::kAzimuths - 1, 0})
    for (int row = 0; row < LobeData::kCosines; ++row) {
      const double angle_deg = std::acos(LobeData::cosine(row)) * 180 / kPi;
      simulated.x.push_back(column == 0 ? angle_deg : -angle_deg);
      const int cell = row * LobeData::kAzimuths + column;
      simulated.y.push_back(f.data.energy[static_cast<std::size_t>(cell)]);
    }
  panel.series.push_back(std::move(simulated));
  const auto add = [&](const char* name, int colour, const auto& model) {
    ChartSeries series{name, seriesColour(colour), {}, {}};
    for (int degree = -89; degree <= 89; ++degree) {
      // Where the simulated cells next to the plane have their centres.
      const double azimuth = LobeData::azimuth(degree < 0 ? LobeData::kAzimuths - 1 : 0);
      series.x.push_back(degree);
      series.y.push_back(model(std::cos(std::abs(degree) * kPi / 180), azimuth));
    }
    panel.series.push_back(std::move(series));
  };
  add("free lobe", 3, freeModel(f));
  add("refit", 2, polynomialModel(fits.data.refit, f.data));
  add("PAT18 code", 1, polynomialModel(kPublishedCode, f.data));
  add("PAT18 text", 4, polynomialModel(kPublishedText, f.data));
  return panel;
}

}  // namespace

int LobeFits::orders() const {
  return static_cast<int>(lobes.size() / (alphas.size() * incidences_deg.size()));
}

const FittedLobe& LobeFits::at(std::size_t alpha, std::size_t incidence, int order) const {
  const auto per_cell = static_cast<std::size_t>(orders());
  return lobes.at((alpha * incidences_deg.size() + incidence) * per_cell +
                  static_cast<std::size_t>(order - 1));
}

std::string freeLobesCsv(const LobeFits& fits) {
  std::string text =
      "alpha,mu,order,share,scale,exponent,roughness,flattening,deviation_rad,masking,error,"
      "error_unmasked\n";
  for (const FittedLobe& f : fits.lobes)
    text += fmt::format(
        "{:.4f},{:.6f},{},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n",
        f.data.alpha, f.data.mu_in, f.data.order, f.data.share, f.lobe.scale, f.lobe.exponent,
        f.lobe.roughness(), f.lobe.flattening, f.lobe.deviation_rad, f.lobe.masking, f.lobe.error,
        f.error_unmasked);
  return text;
}

std::string lobeErrorTable(const LobeFits& fits, int order) {
  TextTable table({fmt::format("order {}: alpha", order), "free lobe", "no masking", "PAT18 text",
                   "PAT18 code", "refit", "simulated share", "code's", "refit's"});
  const auto share = [order](const LobePolynomials& set, const LobeData& data) {
    return lobeShare(lobeAt(set, data.mu_in, data.alpha)) *
           (order == 3 ? set.thirdOverSecond(data.alpha) : 1);
  };
  for (std::size_t a = 0; a < fits.alphas.size(); ++a) {
    double sums[8] = {};
    for (std::size_t i = 0; i < fits.incidences_deg.size(); ++i) {
      const FittedLobe& f = fits.at(a, i, order);
      sums[0] += f.lobe.error;
      sums[1] += f.error_unmasked;
      int column = 2;
      for (const NamedSet& named : setsOf(fits))
        sums[column++] += lobeError(f.data, polynomialModel(*named.set, f.data));
      sums[5] += f.data.share;
      sums[6] += share(kPublishedCode, f.data);
      sums[7] += share(fits.data.refit, f.data);
    }
    std::vector<std::string> row = {fmt::format("{:.3f}", fits.alphas[a])};
    for (const double sum : sums)
      row.push_back(fixed(sum / static_cast<double>(fits.incidences_deg.size())));
    table.addRow(row);
  }
  return table.toString();
}

std::string coefficientTable(const LobeFits& fits) {
  TextTable table({"coefficients", "of", "1", "alpha", "alpha^2", "alpha^3"});
  const auto row = [&](const std::string& what, const char* name, auto... c) {
    std::vector<std::string> cells = {what, name, fmt::format("{:.6f}", c)...};
    cells.resize(6);
    table.addRow(cells);
  };
  for (const bool scale : {true, false})
    for (std::size_t power = 0; power < 4; ++power)
      for (const NamedSet& named : setsOf(fits)) {
        const auto& c = scale ? named.set->scale[power] : named.set->flattening[power];
        row(fmt::format("{} of mu^{}", scale ? "scale" : "flattening", power), named.name, c[0],
            c[1], c[2], c[3]);
      }
  for (const NamedSet& named : setsOf(fits))
    row("exponent", named.name, 0.0, named.set->exponent[0], named.set->exponent[1]);
  for (const NamedSet& named : setsOf(fits))
    row("order 3 over 2; knee", named.name, named.set->third_order, named.set->third_order_knee);
  return table.toString();
}

std::string eonTable(const LobeFits& fits) {
  TextTable table({"all orders: alpha", "EON r", "error, r fitted", "error, r = alpha", "Lambert",
                   "refit", "PAT18 code", "fitted"});
  for (std::size_t a = 0; a < fits.alphas.size(); ++a) {
    const double alpha = fits.alphas[a], r = fits.data.eon.at(alpha);
    double sums[6] = {};
    const ScatterModel fitted(fits.data.fitted.at(alpha));
    for (std::size_t i = 0; i < fits.incidences_deg.size(); ++i) {
      const LobeData& data = fits.totals[a * fits.incidences_deg.size() + i];
      const double mu = data.mu_in;
      const auto eon = [mu](double roughness) {
        return [mu, roughness](double cosine, double azimuth) {
          return eonEnergy(roughness, mu, cosine, azimuth);
        };
      };
      const auto whole = [&](const LobePolynomials& set) {
        return [model = LobeModel(set, alpha), mu](double cosine, double) {
          return model.energy(1, mu, cosine);
        };
      };
      sums[0] += lobeError(data, eon(r));
      sums[1] += lobeError(data, eon(alpha));
      sums[2] += lobeError(data, [](double cosine, double) { return cosine / kPi; });
      sums[3] += lobeError(data, whole(fits.data.refit));
      sums[4] += lobeError(data, whole(kPublishedCode));
      sums[5] += lobeError(data, [&](double cosine, double azimuth) {
        return fitted.energy(1, mu, cosine, azimuth);
      });
    }
    std::vector<std::string> row = {fmt::format("{:.3f}", alpha), fmt::format("{:.3f}", r)};
    for (const double sum : sums)
      row.push_back(fixed(sum / static_cast<double>(fits.incidences_deg.size())));
    table.addRow(row);
  }
  return table.toString();
}

std::string mirrorTable(const LobeFits& fits) {
  const MirrorAlbedo& mirror = fits.data.mirror;
  constexpr double kMus[] = {0.1, 0.2, 0.4, 0.7, 1};
  std::vector<std::string> header = {"mirror: alpha", "of"};
  for (const double mu : kMus) header.push_back(fmt::format("mu {}", mu));
  TextTable table(header);
  for (const double alpha : {0.125, 0.25, 0.5, 0.75, 1.0})
    for (const bool simulated : {true, false}) {
      std::vector<std::string> row = {fmt::format("{:.3f}", alpha),
                                      simulated ? "simulated surface" : "kernels' lobe"};
      for (const double mu : kMus)
        row.push_back(fixed(mirror.at(simulated ? mirror.simulated : mirror.lobe, alpha,
                                      MirrorAlbedo::warp(alpha, mu))));
      table.addRow(row);
    }
  return table.toString();
}

Image residualPicture(const LobeFits& fits) {
  std::vector<ChartPanel> panels;
  for (const std::size_t incidence : {std::size_t{0}, std::size_t{6}})
    for (const std::size_t alpha : {std::size_t{2}, std::size_t{6}, std::size_t{10}}) {
      if (alpha < fits.alphas.size() && incidence < fits.incidences_deg.size())
        panels.push_back(
            lobeSection(fits, fits.at(alpha, incidence, 2), fits.incidences_deg[incidence]));
    }
  const ChartOptions options{.columns = 3,
                             .panel_width_px = 340,
                             .panel_height_px = 230,
                             .x_label = "angle from the normal in degrees, light on the right",
                             .y_label = "order 2, energy per solid angle"};
  return pictureColumn({errorMatrices(fits), lineChart(panels, options)});
}

Image residualDiscs(const LobeFits& fits) {
  std::vector<LobeDisc> discs;
  for (const FittedLobe& f : fits.lobes) {
    const bool shown =
        f.data.order == 2 && std::abs(f.data.mu_in - 0.5) < 1e-6 && f.data.alpha > 0.2;
    if (!shown) continue;
    const double most = *std::ranges::max_element(f.data.energy);
    const auto cell = [&f](double cosine, double azimuth) {
      return cellEnergy(f.data, cosine, azimuth);
    };
    discs.push_back({fmt::format("simulated {:.3f}", f.data.alpha), cell, most});
    const auto residual = [&](const char* name, auto model) {
      discs.push_back({fmt::format("{} {:.3f}", name, f.data.alpha),
                       [cell, model](double cosine, double azimuth) {
                         return std::abs(model(cosine, azimuth) - cell(cosine, azimuth));
                       },
                       most});
    };
    residual("free", freeModel(f));
    residual("refit", polynomialModel(fits.data.refit, f.data));
    residual("published", polynomialModel(kPublishedCode, f.data));
  }
  return lobePicture(discs, 4);
}

}  // namespace glintmark
