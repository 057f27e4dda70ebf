// What single facets do to the rays of the height field: flat surfaces against Fresnel, Snell and
// Lambert, mirrors against the mirrored direction, anisotropic ones against their slopes.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

#include "host/core/angles.h"
#include "host/harness/reference_caster.h"
#include "host/harness/simulation_cases.h"
#include "host/simulate/simulation.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr std::uint64_t kRays = 1 << 16;
// A share of so many rays has a standard error of at most 1/512; four of them.
constexpr double kShareError = 4.0 / 512;
// Directions are counted in cells of 1/128 of the cosine and 1/256 of a turn.
constexpr double kCosineCell = 1.0 / HF_COSINES, kTurnCell = 1.0 / HF_AZIMUTHS;
constexpr double kFlat = 5e-4;  // roughness

Simulation traced(const CheckContext& context, const SimulationSettings& settings) {
  return Simulator(context.bench.device, context.bench.cache, context.lanes).run(settings);
}

SimulationSettings flat(SurfaceKind kind, double incidence_deg, double n, double k = 0) {
  SimulationSettings s;
  s.kind = kind;
  s.alpha = glm::dvec2(kFlat);
  s.incidence_deg = incidence_deg;
  s.azimuth_deg = 30;
  s.index_n = n;
  s.index_k = k;
  s.rays = kRays;
  return s;
}

// Reflectance of unpolarised light at a boundary of relative index n - ik. (M. Born, E. Wolf,
// "Principles of Optics", Sect. 1.5 and 14.2.)
double fresnel(double cosine, std::complex<double> index) {
  const std::complex<double> sine_sq = 1 - cosine * cosine;
  const std::complex<double> far = std::sqrt(1.0 - sine_sq / (index * index));
  const std::complex<double> s = (cosine - index * far) / (cosine + index * far);
  const std::complex<double> p = (index * cosine - far) / (index * cosine + far);
  return 0.5 * (std::norm(s) + std::norm(p));
}

Finding metals(const CheckContext& context) {
  Finding finding(kShareError);
  for (const auto& [n, k] : {std::pair{0.2, 3.9}, {2.9, 3.1}, {1.5, 0.5}})
    for (const double incidence_deg : {0.0, 50.0, 75.0, 85.0})
      finding.add(
          std::abs(orderEnergy(traced(context, flat(SurfaceKind::kMetal, incidence_deg, n, k)), 1) -
                   fresnel(std::cos(incidence_deg * kDegree), {n, k})));
  return finding;
}

// Schlick's term with a tint: at 82 degrees it is `tint` times as much, straight on and along the
// surface as much as without.
Finding tintedMetals(const CheckContext& context) {
  Finding finding(kShareError);
  for (const auto& [f0, tint] : {std::pair{0.2, 1.0}, {0.9, 0.3}, {0.5, 0.6}}) {
    const auto schlick = [f0 = f0](double cosine) {
      return f0 + (1 - f0) * std::pow(1 - cosine, 5);
    };
    const double at_82 = 1.0 / 7;
    for (const double cosine : {1.0, 0.6, 0.3, at_82, 0.08}) {
      SimulationSettings s = flat(SurfaceKind::kMetal, std::acos(cosine) / kDegree, 1.5);
      s.f0 = f0;
      s.tint = tint;
      // The dip's own shape, 1 at 82 degrees.
      const double dip = cosine / at_82 * std::pow((1 - cosine) / (1 - at_82), 6);
      finding.add(std::abs(orderEnergy(traced(context, s), 1) -
                           (schlick(cosine) - (1 - tint) * schlick(at_82) * dip)));
    }
  }
  return finding;
}

// Mean cosine and azimuth [turns] of what leaves on a side after one bounce.
struct Leaving {
  double share = 0, cosine = 0, x = 0, y = 0;
  double turn() const {
    const double t = std::atan2(y, x) / (2 * kPi);
    return t < 0 ? t + 1 : t;
  }
};

Leaving leaving(const Simulation& s, int side) {
  Leaving sum;
  for (std::size_t c = 0; c < HF_COSINES; ++c)
    for (std::size_t a = 0; a < HF_AZIMUTHS; ++a) {
      const auto count =
          static_cast<double>(s.cell(side, 1, c, a)) / static_cast<double>(s.rays_done);
      const double phi = 2 * kPi * (static_cast<double>(a) + 0.5) * kTurnCell;
      sum.share += count;
      sum.cosine += count * (1 - (static_cast<double>(c) + 0.5) * kCosineCell);
      sum.x += count * std::cos(phi);
      sum.y += count * std::sin(phi);
    }
  if (sum.share > 0) sum.cosine /= sum.share;
  return sum;
}

double turnsApart(double a, double b) {
  const double d = std::abs(a - b);
  return std::min(d, 1 - d);
}

// Into denser and thinner media: how much comes back, and where the two parts go.
Finding dielectrics(const CheckContext& context) {
  Finding finding(1);
  for (const double n : {1.5, 2.4, 1 / 1.5})
    for (const double incidence_deg : {20.0, 40.0, 60.0, 80.0}) {
      const Simulation s = traced(context, flat(SurfaceKind::kDielectric, incidence_deg, n));
      const double cosine = std::cos(incidence_deg * kDegree);
      const double sine = std::sin(incidence_deg * kDegree) / n;
      const Leaving above = leaving(s, 0), below = leaving(s, 1);
      const double want = sine >= 1 ? 1 : fresnel(cosine, n);
      finding.add(std::abs(above.share - want) / kShareError);
      finding.add(std::abs(above.share + below.share - 1) / kShareError);
      finding.add(std::abs(above.cosine - cosine) / kCosineCell);
      finding.add(turnsApart(above.turn(), 30.0 / 360 + 0.5) / kTurnCell);
      if (sine >= 1) continue;
      finding.add(std::abs(below.cosine - std::sqrt(1 - sine * sine)) / kCosineCell);
      finding.add(turnsApart(below.turn(), 30.0 / 360 + 0.5) / kTurnCell);
    }
  return finding;
}

// Lambert's: a share of mu^2 leaves at cosines below mu, and every azimuth has as much.
Finding diffuseFacets(const CheckContext& context) {
  Finding finding(kShareError);
  for (const double incidence_deg : {0.0, 70.0}) {
    const Simulation s = traced(context, flat(SurfaceKind::kDiffuse, incidence_deg, 1));
    double above = 0;
    for (std::size_t c = 0; c < HF_COSINES; ++c) {
      for (std::size_t a = 0; a < HF_AZIMUTHS; ++a)
        above += static_cast<double>(s.cell(0, 1, c, a)) / kRays;
      const double mu = 1 - static_cast<double>(c + 1) * kCosineCell;
      finding.add(std::abs(above - (1 - mu * mu)));
    }
    double turned = 0;
    for (std::size_t a = 0; a < HF_AZIMUTHS; ++a) {
      for (std::size_t c = 0; c < HF_COSINES; ++c)
        turned += static_cast<double>(s.cell(0, 1, c, a)) / kRays;
      finding.add(std::abs(turned - static_cast<double>(a + 1) * kTurnCell));
    }
  }
  return finding;
}

// Seen and lit along the normal, first bounces are the slopes' own distribution: variances of
// alpha^2 / 2 along each axis. Relative; cells of directions are wide against the narrow axis.
Finding anisotropicSlopes(const CheckContext& context) {
  Finding finding(0.15);
  for (const glm::dvec2 alpha : {glm::dvec2(0.3, 0.15), glm::dvec2(0.15, 0.3)}) {
    SimulationSettings settings = mirror(0.3, 0, 1 << 18);
    settings.alpha = alpha;
    settings.orders = 1;
    settings.last_bounce_leaves = true;
    const Simulation s = traced(context, settings);
    glm::dvec2 squares(0);
    double all = 0;
    for (std::size_t c = 0; c < HF_COSINES; ++c)
      for (std::size_t a = 0; a < HF_AZIMUTHS; ++a) {
        const auto count = static_cast<double>(s.cell(0, 1, c, a));
        const double z = 1 - (static_cast<double>(c) + 0.5) * kCosineCell;
        const double phi = 2 * kPi * (static_cast<double>(a) + 0.5) * kTurnCell;
        const double slope = std::sqrt((1 - z) / (1 + z));  // tangent of half the angle
        squares += count * glm::dvec2(std::pow(slope * std::cos(phi), 2),
                                      std::pow(slope * std::sin(phi), 2));
        all += count;
      }
    for (int axis = 0; axis < 2; ++axis)
      finding.add(std::abs(squares[axis] / all / (alpha[axis] * alpha[axis] / 2) - 1));
  }
  return finding;
}

// The same surface, other rays: shares that leave after one and two bounces, against a caster in
// double precision that goes from cell to cell. In standard errors of its own.
Finding caster(const CheckContext& context) {
  constexpr int kCasterRays = 40000;
  Finding finding(5);  // beyond: a chance of 6e-7 each
  for (const double azimuth_deg : {25.0, 200.0}) {
    SimulationSettings settings = mirror(0.9, 70, kRaysPerSurface);
    settings.azimuth_deg = azimuth_deg;
    Simulator simulator(context.bench.device, context.bench.cache, context.lanes);
    const Simulation simulation = simulator.run(settings);
    const double alpha = settings.alpha.x;
    const ReferenceCaster reference(simulator.surface().readCounts(),
                                    alpha * simulator.surface().countHeight());
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> texel(0, HF_TILE);
    double left[3] = {};
    for (int i = 0; i < kCasterRays; ++i) {
      const double x = texel(random), y = texel(random);
      const int count = reference.bounces({x, y, reference.top()}, -incidentDirection(settings), 2);
      if (count <= 2) ++left[count];
    }
    for (const int order : {1, 2}) {
      const double want = left[order] / kCasterRays;
      finding.add(std::abs(orderEnergy(simulation, order) - want) /
                  std::sqrt(want * (1 - want) / kCasterRays));
    }
  }
  return finding;
}

}  // namespace

std::vector<Check> facetChecks() {
  return {
      {"height_field/caster", "standard errors of a caster in doubles", caster},

      {"height_field/metals", "error of Fresnel's reflectance", metals},
      {"height_field/tinted_metals", "error of Schlick's reflectance with a tint", tintedMetals},
      {"height_field/dielectrics", "error in units of its bound", dielectrics},
      {"height_field/diffuse", "error of Lambert's distribution", diffuseFacets},
      {"height_field/anisotropic", "relative error of the slopes' variance", anisotropicSlopes}};
}

}  // namespace glintmark
