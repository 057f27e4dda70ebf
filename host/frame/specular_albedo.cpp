#include "host/frame/specular_albedo.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

#include "host/core/angles.h"
#include "host/fit/multiscatter_types.h"
#include "host/frame/chebyshev.h"

namespace glintmark {
namespace {

constexpr reference::SmithForm kForm = reference::SmithForm::kRational;  // the kernels'

}  // namespace

SplitAlbedo specularAlbedo(reference::Ndf ndf, double mu, double alpha) {
  // Normals m drawn from D(m) m.z, quantile by quantile: E = mean of G (o.m) / (o.z m.z).
  constexpr int kSlopes = 96, kAzimuths = 32;  // azimuths over half a turn
  const glm::dvec3 o(std::sqrt(std::max(1 - mu * mu, 0.0)), 0, mu);
  const double view_term = mu + reference::lambdaTimesCosine(ndf, o, alpha, kForm);
  SplitAlbedo sum;
  for (int k = 0; k < kSlopes; ++k) {
    const double u = (k + 0.5) / kSlopes;
    const double slope =
        alpha * std::sqrt(ndf == reference::Ndf::kGgx ? u / (1 - u) : -std::log1p(-u));
    for (int j = 0; j < kAzimuths; ++j) {
      const double phi = (j + 0.5) * kPi / kAzimuths;
      const double z = 1 / std::sqrt(1 + slope * slope);
      const glm::dvec3 m(slope * std::cos(phi) * z, slope * std::sin(phi) * z, z);
      const double facing = glm::dot(o, m);
      const glm::dvec3 i = 2 * facing * m - o;
      if (facing <= 0 || i.z <= 0) continue;
      // G / o.z = 1 / (o.z + o.z Lambda(o) + o.z Lambda(i)).
      const double masked = view_term + mu * reference::lambdaTimesCosine(ndf, i, alpha, kForm) /
                                            std::max(i.z, 1e-12);
      const double value = facing / (std::max(masked, 1e-12) * z);
      sum.mirror += value;
      sum.schlick += value * std::pow(1 - std::min(facing, 1.0), 5);
    }
  }
  return {sum.mirror / (kSlopes * kAzimuths), sum.schlick / (kSlopes * kAzimuths)};
}

namespace {

struct AlbedoSeries {
  float mirror[GM_ALBEDO_DEGREES], share[GM_ALBEDO_DEGREES];
};

AlbedoSeries fitAlbedo(reference::Ndf ndf, double alpha, double warp) {
  AlbedoSeries series{};
  interpolateAtChebyshevPoints(
      [&](double t) { return specularAlbedo(ndf, t * warp / (1 + warp - t), alpha).mirror; },
      series.mirror);
  interpolateAtChebyshevPoints(
      [&](double mu) {
        const SplitAlbedo albedo = specularAlbedo(ndf, mu, alpha);
        return albedo.schlick / albedo.mirror;
      },
      series.share);
  return series;
}

}  // namespace

void setSpecularAlbedo(SurfaceMaterial& surface, bool ggx) {
  // Scenes of many materials have few roughnesses: albedos of the nearest of these are close
  // enough.
  constexpr double kRoughnesses = 1024;
  static std::mutex mutex;
  static std::map<std::pair<bool, int>, AlbedoSeries> known;
  const double alpha = std::sqrt(static_cast<double>(surface.alpha_g.x) * surface.alpha_g.y);
  const int step = std::max(1, static_cast<int>(std::lround(alpha * kRoughnesses)));
  const double rounded = step / kRoughnesses, warp = MS_WARP * rounded;
  const std::scoped_lock lock(mutex);
  const auto [entry, is_new] = known.try_emplace({ggx, step});
  if (is_new)
    entry->second =
        fitAlbedo(ggx ? reference::Ndf::kGgx : reference::Ndf::kBeckmann, rounded, warp);
  std::ranges::copy(entry->second.mirror, surface.mirror_albedo);
  std::ranges::copy(entry->second.share, surface.schlick_share);
  surface.albedo_warp = static_cast<float>(warp);
}

}  // namespace glintmark
