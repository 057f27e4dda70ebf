#include "host/fit/multiscatter_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "host/core/error.h"
#include "host/fit/data_folder.h"

namespace glintmark {
namespace {

constexpr const char* kSchema = "glintmark.multiscatter/1";

// Index of the cell of `x` in ascending `grid`, and how far in it.
std::pair<std::size_t, double> locate(const std::vector<double>& grid, double x) {
  const auto upper = std::upper_bound(grid.begin(), grid.end(), x) - grid.begin();
  const auto cell = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(upper - 1, 0, static_cast<std::ptrdiff_t>(grid.size()) - 2));
  return {cell, std::clamp((x - grid[cell]) / (grid[cell + 1] - grid[cell]), 0.0, 1.0)};
}

}  // namespace

double MirrorAlbedo::at(double alpha, double mu) const {
  const auto [i, s] = locate(alphas, alpha);
  const auto [j, t] = locate(mus, mu);
  const auto value = [&](std::size_t a, std::size_t m) { return energy[a * mus.size() + m]; };
  return (1 - s) * ((1 - t) * value(i, j) + t * value(i, j + 1)) +
         s * ((1 - t) * value(i + 1, j) + t * value(i + 1, j + 1));
}

std::string toJson(const MultiscatterData& data) {
  const nlohmann::json json = {
      {"schema", kSchema},
      {"source", data.source},
      {"refit",
       {{"scale", data.refit.scale},
        {"exponent", data.refit.exponent},
        {"flattening", data.refit.flattening},
        {"third_order", data.refit.third_order}}},
      {"mirror",
       {{"alpha", data.mirror.alphas}, {"mu", data.mirror.mus}, {"energy", data.mirror.energy}}}};
  return json.dump(1) + "\n";
}

MultiscatterData readMultiscatterData(const std::filesystem::path& path) {
  std::ifstream file(path);
  MultiscatterData data;
  try {
    const nlohmann::json json = nlohmann::json::parse(file);
    if (json.at("schema") != kSchema)
      throw Error(fmt::format("{} is of another schema than {}", path.string(), kSchema));
    json.at("source").get_to(data.source);
    const nlohmann::json& refit = json.at("refit");
    refit.at("scale").get_to(data.refit.scale);
    refit.at("exponent").get_to(data.refit.exponent);
    refit.at("flattening").get_to(data.refit.flattening);
    refit.at("third_order").get_to(data.refit.third_order);
    const nlohmann::json& mirror = json.at("mirror");
    mirror.at("alpha").get_to(data.mirror.alphas);
    mirror.at("mu").get_to(data.mirror.mus);
    mirror.at("energy").get_to(data.mirror.energy);
  } catch (const nlohmann::json::exception& error) {
    throw Error(
        fmt::format("{} does not hold lobes and a mirror's albedo ({}); make it with "
                    "glintmark fit lobes",
                    path.string(), error.what()));
  }
  const MirrorAlbedo& m = data.mirror;
  const bool good = m.alphas.size() >= 2 && m.mus.size() >= 2 &&
                    m.energy.size() == m.alphas.size() * m.mus.size() &&
                    std::ranges::is_sorted(m.alphas) && std::ranges::is_sorted(m.mus) &&
                    std::ranges::all_of(m.energy, [](double e) { return e > 0 && e <= 1; });
  if (!good)
    throw Error(
        fmt::format("the mirror's albedo in {} is not a table of shares in (0, 1]", path.string()));
  return data;
}

const MultiscatterData& multiscatterData() {
  static const MultiscatterData data = readMultiscatterData(findDataFile("multiscatter.json"));
  return data;
}

}  // namespace glintmark
