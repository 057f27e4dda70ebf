#include "host/fit/multiscatter_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "host/core/atomic_file.h"
#include "host/core/error.h"
#include "host/core/fnv1a.h"
#include "host/core/json_depth.h"
#include "host/fit/data_folder.h"
#include "host/fit/multiscatter_types.h"

namespace glintmark {
namespace {

constexpr const char* kSchema = "glintmark.multiscatter/4";

constexpr const char* kChecksum = "checksum";

// FNV-1a of everything else, as it is written without spaces.
std::string checksumOf(const nlohmann::json& json) {
  nlohmann::json rest = json;
  rest.erase(kChecksum);
  return fmt::format("{:016x}", fnv1a(rest.dump()));
}

// Index of the cell of `x` in ascending `grid`, and how far in it.
std::pair<std::size_t, double> locate(const std::vector<double>& grid, double x) {
  const auto upper = std::upper_bound(grid.begin(), grid.end(), x) - grid.begin();
  const auto cell = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(upper - 1, 0, static_cast<std::ptrdiff_t>(grid.size()) - 2));
  return {cell, std::clamp((x - grid[cell]) / (grid[cell + 1] - grid[cell]), 0.0, 1.0)};
}

}  // namespace

double MirrorAlbedo::at(const std::vector<double>& energy, double alpha, double t) const {
  const auto [i, x] = locate(alphas, alpha);
  const auto [j, y] = locate(warped, t);
  const auto value = [&](std::size_t a, std::size_t m) { return energy[a * warped.size() + m]; };
  return (1 - x) * ((1 - y) * value(i, j) + y * value(i, j + 1)) +
         x * ((1 - y) * value(i + 1, j) + y * value(i + 1, j + 1));
}

double MirrorAlbedo::warp(double alpha, double mu) {
  const double s = MS_WARP * alpha;
  return mu * (1 + s) / (mu + s);
}

double MirrorAlbedo::cosine(double alpha, double t) {
  const double s = MS_WARP * alpha;
  return t * s / (1 + s - t);
}

std::string toJson(const MultiscatterData& data) {
  nlohmann::json json = {{"schema", kSchema},
                         {"source", data.source},
                         {"refit",
                          {{"scale", data.refit.scale},
                           {"exponent", data.refit.exponent},
                           {"flattening", data.refit.flattening},
                           {"third_order", data.refit.third_order},
                           {"third_order_knee", data.refit.third_order_knee}}},
                         {"eon_roughness", {{"top", data.eon.top}, {"knee", data.eon.knee}}},
                         {"fitted", {{"first", data.fitted.first}, {"knee", data.fitted.knee}}},
                         {"mirror",
                          {{"alpha", data.mirror.alphas},
                           {"warped_mu", data.mirror.warped},
                           {"simulated", data.mirror.simulated},
                           {"lobe", data.mirror.lobe}}}};
  json[kChecksum] = checksumOf(json);
  return json.dump(1) + "\n";
}

MultiscatterData readMultiscatterData(const std::filesystem::path& path) {
  MultiscatterData data;
  try {
    const std::string text = readFile(path, FileRole::kOwn);
    checkJsonDepth(text, path.string());
    const nlohmann::json json = nlohmann::json::parse(text);
    if (json.at("schema") != kSchema)
      throw Error(fmt::format("{} is of another schema than {}", path.string(), kSchema));
    if (json.at(kChecksum) != checksumOf(json))
      throw Error(
          fmt::format("{} is damaged: its checksum does not match its content; make it with "
                      "glintmark fit lobes",
                      path.string()));
    json.at("source").get_to(data.source);
    const nlohmann::json& refit = json.at("refit");
    refit.at("scale").get_to(data.refit.scale);
    refit.at("exponent").get_to(data.refit.exponent);
    refit.at("flattening").get_to(data.refit.flattening);
    refit.at("third_order").get_to(data.refit.third_order);
    refit.at("third_order_knee").get_to(data.refit.third_order_knee);
    const nlohmann::json& eon = json.at("eon_roughness");
    eon.at("top").get_to(data.eon.top);
    eon.at("knee").get_to(data.eon.knee);
    const nlohmann::json& fitted = json.at("fitted");
    fitted.at("first").get_to(data.fitted.first);
    fitted.at("knee").get_to(data.fitted.knee);
    const nlohmann::json& mirror = json.at("mirror");
    mirror.at("alpha").get_to(data.mirror.alphas);
    mirror.at("warped_mu").get_to(data.mirror.warped);
    mirror.at("simulated").get_to(data.mirror.simulated);
    mirror.at("lobe").get_to(data.mirror.lobe);
  } catch (const nlohmann::json::exception& error) {
    throw Error(
        fmt::format("{} does not hold lobes and a mirror's albedo ({}); make it with "
                    "glintmark fit lobes",
                    path.string(), error.what()));
  }
  const MirrorAlbedo& m = data.mirror;
  const auto shares = [&m](const std::vector<double>& energy) {
    return energy.size() == m.alphas.size() * m.warped.size() &&
           std::ranges::all_of(energy, [](double e) { return e > 0 && e <= 1; });
  };
  const bool good = m.alphas.size() >= 2 && m.warped.size() >= 2 &&
                    std::ranges::is_sorted(m.alphas) && std::ranges::is_sorted(m.warped) &&
                    shares(m.simulated) && shares(m.lobe);
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
