// What [TAN05] approximates against what it approximates: a base lobe averaged over a Gaussian of
// normals, and a texture averaged over a pixel's parallelogram, both summed point by point.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "host/core/angles.h"
#include "host/filter/mip_chain.h"
#include "host/harness/pixel_harness.h"
#include "host/harness/texture_harness.h"
#include "host/reference/beckmann.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

constexpr int kNormalSteps = 80;
// Where a Gaussian is cut: 1 % of the fit of its mass, and what lobes of slopes and of normals
// differ by.
constexpr double kRimLobes = 0.06;
// Long lobes, where the base lobe is as wide as they are across.
constexpr double kLongLobes = 0.03;
// Of the mean of normals on the disk, from their projection's moments.
constexpr double kMeanCosines = 0.012;
// Lights that fewer of the normals turn from: what those would take away is not asked for.
constexpr double kTurnedAway = 1e-3;

struct ConvolutionCase {
  double alpha, variance, tilt;  // tilt: sine of the mean normal's angle
};

// Radiance of one normal, without Fresnel's term, and its cosine.
struct NormalLight {
  double specular = 0, cosine = 0;
};

NormalLight lightNormal(const glm::dvec3& n, const glm::dvec3& light, const glm::dvec3& view,
                        double alpha) {
  const glm::dvec3 t = glm::normalize(
      glm::cross(std::abs(n.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), n));
  const glm::dvec3 b = glm::cross(n, t);
  const auto local = [&](const glm::dvec3& w) {
    return glm::dvec3(glm::dot(t, w), glm::dot(b, w), glm::dot(n, w));
  };
  return {reference::brdfTimesCosine(local(light), local(view), glm::dvec2(alpha), glm::dvec3(1)).x,
          std::max(glm::dot(n, light), 0.0)};
}

// The mean over a Gaussian of normals projected onto the tangent plane, of those that lie on the
// unit disk: there are no others. `axes`: a root of its covariance.
NormalLight meanOverNormals(const glm::dvec2& mean, const glm::dmat2& axes, const glm::dvec3& light,
                            const glm::dvec3& view, double alpha) {
  NormalLight sum;
  double weights = 0;
  for (int i = 0; i < kNormalSteps; ++i)
    for (int j = 0; j < kNormalSteps; ++j) {
      const glm::dvec2 d = 4.5 * (glm::dvec2(2 * i + 1, 2 * j + 1) / double{kNormalSteps} - 1.0);
      const double weight = std::exp(-0.5 * glm::dot(d, d));
      const glm::dvec2 n = mean + axes * d;
      if (glm::dot(n, n) >= 1) continue;
      weights += weight;
      const NormalLight one =
          lightNormal({n.x, n.y, std::sqrt(1 - glm::dot(n, n))}, light, view, alpha);
      sum.specular += weight * one.specular;
      sum.cosine += weight * one.cosine;
    }
  return {sum.specular / weights, sum.cosine / weights};
}

// Lobes over all directions of light around where they are brightest, relative to that.
Finding lobes(const CheckContext& context, const std::vector<ConvolutionCase>& cases,
              double bound) {
  constexpr std::size_t kDirections = 64;
  Finding finding(bound);
  std::mt19937 random(41);
  const auto unit = [&] { return std::uniform_real_distribution<double>()(random); };
  for (const ConvolutionCase& c : cases) {
    const double turn = 2 * kPi * unit();
    const glm::dvec2 mean = c.tilt * glm::dvec2(std::cos(turn), std::sin(turn));
    const glm::dvec3 n(mean, std::sqrt(1 - c.tilt * c.tilt));
    const glm::dvec3 view =
        glm::normalize(n + glm::dvec3(0.6 * (unit() - 0.5), 0.6 * (unit() - 0.5), 0.2));
    std::vector<float> in(10 * kDirections), out(6 * kDirections);
    std::vector<glm::dvec3> lights;
    const double width = std::sqrt(c.alpha * c.alpha + 2 * c.variance);
    while (lights.size() < kDirections) {
      const glm::dvec3 m = glm::normalize(
          n + width * glm::dvec3(2.4 * (unit() - 0.5), 2.4 * (unit() - 0.5), 2.4 * (unit() - 0.5)));
      const glm::dvec3 light = glm::normalize(2 * glm::dot(view, m) * m - view);
      if (glm::dot(light, n) > 0.2 && light.z > 0.05) lights.push_back(light);
    }
    const double moments[] = {1, mean.x, mean.y, 2 * c.variance + glm::dot(mean, mean)};
    for (std::size_t i = 0; i < kDirections; ++i)
      for (std::size_t k = 0; k < 10; ++k)
        in[k * kDirections + i] = static_cast<float>(k < 4   ? moments[k]
                                                     : k < 7 ? lights[i][static_cast<int>(k - 4)]
                                                             : view[static_cast<int>(k - 7)]);
    Buffer output(context.bench.device, out.size() * 4, BufferPurpose::kProbe, "shaded lobes");
    const std::vector<KernelArg> args = {probeData(context.bench, in), output,
                                         static_cast<std::uint32_t>(kDirections),
                                         static_cast<float>(c.alpha)};
    probeKernel(context.bench, "probes/probe_lobe.cl", "probeLobe",
                fmt::format("-D WIDTH={} -D DIFFUSE=1 -D NORMAL_MAP=1 -D LOBES=1", context.lanes))
        .launch(args, kDirections / static_cast<std::size_t>(context.lanes), kLocalSize);
    output.read(out.data(), out.size() * 4);
    std::vector<NormalLight> want;
    double brightest = 0;
    for (const glm::dvec3& light : lights) {
      want.push_back(
          meanOverNormals(mean, glm::dmat2(std::sqrt(c.variance)), light, view, c.alpha));
      brightest = std::max(brightest, want.back().specular);
    }
    for (std::size_t i = 0; i < kDirections; ++i)
      finding.add(std::abs(out[4 * kDirections + i] - want[i].specular) / brightest);
  }
  return finding;
}

// Normals of a Gaussian that is cut at the rim: what a texel stores of them, and of each light the
// mean cosine, and how much of that is owed to normals that turn from the light.
struct CutNormals {
  glm::dvec2 mean{0, 0};
  double square = 0;  // mean of |n.xy|^2
  std::vector<double> cosines, turned_away;
};

CutNormals cutNormals(const glm::dvec2& mean, double variance,
                      const std::vector<glm::dvec3>& lights) {
  CutNormals sum;
  sum.cosines.assign(lights.size(), 0);
  sum.turned_away.assign(lights.size(), 0);
  double weights = 0;
  for (int i = 0; i < kNormalSteps; ++i)
    for (int j = 0; j < kNormalSteps; ++j) {
      const glm::dvec2 d = 4.5 * (glm::dvec2(2 * i + 1, 2 * j + 1) / double{kNormalSteps} - 1.0);
      const glm::dvec2 n = mean + std::sqrt(variance) * d;
      const double square = glm::dot(n, n), weight = std::exp(-0.5 * glm::dot(d, d));
      if (square >= 1) continue;
      weights += weight;
      sum.mean += weight * n;
      sum.square += weight * square;
      for (std::size_t l = 0; l < lights.size(); ++l) {
        const double cosine = glm::dot(glm::dvec3(n, std::sqrt(1 - square)), lights[l]);
        sum.cosines[l] += weight * std::max(cosine, 0.0);
        sum.turned_away[l] += weight * std::max(-cosine, 0.0);
      }
    }
  sum.mean /= weights;
  sum.square /= weights;
  for (std::size_t l = 0; l < lights.size(); ++l) {
    sum.cosines[l] /= weights;
    sum.turned_away[l] /= weights;
  }
  return sum;
}

// A lobe's cosine is the mean over the normals whose moments it has, under lights that all of them
// face, from the middle of the disk to its rim.
Finding meanCosines(const CheckContext& context) {
  constexpr std::size_t kLights = 64;
  Finding finding(kMeanCosines);
  std::mt19937 random(53);
  const auto unit = [&] { return std::uniform_real_distribution<double>()(random); };
  int asked = 0;
  for (const double tilt : {0.0, 0.5, 0.7, 0.8, 0.9, 0.95})
    for (const double variance : {0.002, 0.01, 0.024, 0.05}) {
      const double turn = 2 * kPi * unit();
      const glm::dvec2 middle = tilt * glm::dvec2(std::cos(turn), std::sin(turn));
      std::vector<glm::dvec3> lights;
      for (std::size_t l = 0; l < kLights; ++l) {
        const double z = 0.05 + 0.95 * unit(), phi = 2 * kPi * unit(), r = std::sqrt(1 - z * z);
        lights.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
      }
      const CutNormals want = cutNormals(middle, variance, lights);
      std::vector<float> in(10 * kLights), out(6 * kLights);
      for (std::size_t l = 0; l < kLights; ++l) {
        const double values[] = {1,           want.mean.x, want.mean.y, want.square, lights[l].x,
                                 lights[l].y, lights[l].z, 0,           0,           1};
        for (std::size_t k = 0; k < 10; ++k) in[k * kLights + l] = static_cast<float>(values[k]);
      }
      Buffer output(context.bench.device, out.size() * 4, BufferPurpose::kProbe, "shaded lobes");
      const std::vector<KernelArg> args = {probeData(context.bench, in), output,
                                           static_cast<std::uint32_t>(kLights), 0.1f};
      probeKernel(context.bench, "probes/probe_lobe.cl", "probeLobe",
                  fmt::format("-D WIDTH={} -D DIFFUSE=1 -D NORMAL_MAP=1 -D LOBES=1", context.lanes))
          .launch(args, kLights / static_cast<std::size_t>(context.lanes), kLocalSize);
      output.read(out.data(), out.size() * 4);
      for (std::size_t l = 0; l < kLights; ++l) {
        if (want.turned_away[l] > kTurnedAway) continue;
        finding.add(std::abs(out[5 * kLights + l] - want.cosines[l]));
        ++asked;
      }
    }
  finding.require(asked > 300, "too few lights that all normals face");
  return finding;
}

// Specular and cosine of lobes ten times as long as wide, at any angle; `cases` give the greater
// variance.
Finding longLobes(const CheckContext& context, const std::vector<ConvolutionCase>& cases,
                  double bound) {
  constexpr std::size_t kDirections = 64;
  Finding finding(bound);
  std::mt19937 random(47);
  const auto unit = [&] { return std::uniform_real_distribution<double>()(random); };
  for (const ConvolutionCase& c : cases) {
    const double turn = 2 * kPi * unit(), angle = kPi * unit();
    const glm::dvec2 mean = c.tilt * glm::dvec2(std::cos(turn), std::sin(turn));
    const double length = std::sqrt(c.variance), width = 0.1 * length;
    const glm::dmat2 axes(length * glm::dvec2(std::cos(angle), std::sin(angle)),
                          width * glm::dvec2(-std::sin(angle), std::cos(angle)));
    const glm::dmat2 covariance = axes * glm::transpose(axes);
    const glm::dvec3 n(mean, std::sqrt(1 - c.tilt * c.tilt));
    const glm::dvec3 view =
        glm::normalize(n + glm::dvec3(0.6 * (unit() - 0.5), 0.6 * (unit() - 0.5), 0.2));
    const double moments[] = {1,
                              mean.x,
                              mean.y,
                              covariance[0][0] + mean.x * mean.x,
                              covariance[0][1] + mean.x * mean.y,
                              covariance[1][1] + mean.y * mean.y};
    std::vector<float> in(12 * kDirections), out(2 * kDirections);
    std::vector<NormalLight> want;
    double brightest = 0;
    for (std::size_t i = 0; i < kDirections;) {
      const glm::dvec2 off = 2.0 * (axes * glm::dvec2(unit() - 0.5, unit() - 0.5) +
                                    c.alpha * glm::dvec2(unit() - 0.5, unit() - 0.5));
      const glm::dvec3 m = glm::normalize(n + glm::dvec3(off, 0));
      const glm::dvec3 light = glm::normalize(2 * glm::dot(view, m) * m - view);
      if (glm::dot(light, n) < 0.2 || light.z < 0.05) continue;
      for (std::size_t k = 0; k < 12; ++k)
        in[k * kDirections + i] = static_cast<float>(k < 6   ? moments[k]
                                                     : k < 9 ? light[static_cast<int>(k - 6)]
                                                             : view[static_cast<int>(k - 9)]);
      want.push_back(meanOverNormals(mean, axes, light, view, c.alpha));
      brightest = std::max(brightest, want.back().specular);
      ++i;
    }
    Buffer output(context.bench.device, out.size() * 4, BufferPurpose::kProbe, "shaded lobes");
    const std::vector<KernelArg> args = {probeData(context.bench, in), output,
                                         static_cast<std::uint32_t>(kDirections),
                                         static_cast<float>(c.alpha)};
    probeKernel(context.bench, "probes/probe_covariance.cl", "probeCovariance",
                fmt::format("-D WIDTH={} -D DIFFUSE=1", context.lanes))
        .launch(args, kDirections / static_cast<std::size_t>(context.lanes), kLocalSize);
    output.read(out.data(), out.size() * 4);
    for (std::size_t i = 0; i < kDirections; ++i) {
      finding.add(std::abs(out[i] - want[i].specular) / brightest);
      finding.add(std::abs(out[kDirections + i] - want[i].cosine));
    }
  }
  return finding;
}

// Waves of a texture, whose mean over a parallelogram is known: sin(pi a) sin(pi b) / (pi^2 a b)
// times the wave in its middle, a and b the waves along its edges.
struct Wave {
  int u, v;
};
constexpr Wave kWaves[] = {{3, 0}, {0, 5}, {4, 3}, {-2, 6}};
constexpr int kWaveTexels = 256;

double sinc(double x) {
  return std::abs(x) < 1e-9 ? 1 : std::sin(kPi * x) / (kPi * x);
}

TestTexture waveTexture() {
  Image finest(kWaveTexels, kWaveTexels, 4);
  for (int y = 0; y < kWaveTexels; ++y)
    for (int x = 0; x < kWaveTexels; ++x)
      for (std::size_t k = 0; k < 4; ++k)
        finest.at(x, y)[k] = static_cast<float>(
            std::cos(2 * kPi * (kWaves[k].u * (x + 0.5) + kWaves[k].v * (y + 0.5)) / kWaveTexels));
  const MipTexels packed = packMipChain(makeMipChain(finest), 1);
  TestTexture texture;
  texture.header = packed.layout;
  texture.texels.assign(packed.texels.begin(), packed.texels.end());
  return texture;
}

// How far waves of 1 may be off.
struct WaveBounds {
  double worst, mean;
};
// Tents and levels in a row have a parallelogram's second moment, not its shape: at worst 0.1 of a
// wave that is damped to a third. Rows have its shape too.
constexpr WaveBounds kOneRowBounds{0.11, 0.01}, kTwoRowBounds{0.016, 0.0015},
    kFourRowBounds{0.011, 0.0008};

// Footprints up to a tenth of the texture, up to 16 times as long as wide, turned and sheared.
Finding footprints(const CheckContext& context, int rows, const WaveBounds& bounds) {
  std::mt19937 random(43);
  const auto unit = [&] { return std::uniform_real_distribution<double>()(random); };
  std::vector<TexturePixel> pixels(600);
  for (TexturePixel& p : pixels) {
    const double length = 0.1 * std::pow(0.05, unit()), aspect = std::pow(16.0, unit());
    const double turn = 2 * kPi * unit(), shear = unit() - 0.5;
    const glm::dvec2 along(length * std::cos(turn), length * std::sin(turn));
    const glm::dvec2 across = glm::dvec2(-along.y, along.x) / aspect + shear * along / aspect;
    p.u = static_cast<std::uint32_t>(random());
    p.v = static_cast<std::uint32_t>(random());
    p.dudx = static_cast<float>(along.x);
    p.dvdx = static_cast<float>(along.y);
    p.dudy = static_cast<float>(across.x);
    p.dvdy = static_cast<float>(across.y);
  }
  const auto fetched =
      fetchPixels(context.bench, waveTexture(), 1, pixels, {16, rows}, true, context.lanes);
  Finding finding(bounds.worst);
  double mean = 0;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) {
      const TexturePixel& p = pixels[i];
      const Wave& w = kWaves[k];
      const double want = sinc(w.u * p.dudx + w.v * p.dvdx) * sinc(w.u * p.dudy + w.v * p.dvdy) *
                          std::cos(2 * kPi * (w.u * (p.u * 0x1p-32) + w.v * (p.v * 0x1p-32)));
      finding.add(std::abs(fetched[i].values[k] - want));
      mean += std::abs(fetched[i].values[k] - want) / static_cast<double>(4 * pixels.size());
    }
  finding.require(mean < bounds.mean, fmt::format("waves are off by {:.3g} on average", mean));
  return finding;
}

}  // namespace

std::vector<Check> convolutionChecks() {
  // Where one of the two is much narrower, the sum of both is a Gaussian like the wider one. Where
  // both are wide, a lobe of slopes meets one of projected normals, and the exponent is a blend.
  static const std::vector<ConvolutionCase> unlike = {{0.3, 0.002, 0},   {0.15, 0.002, 0.5},
                                                      {0.2, 0.005, 0.6}, {0.1, 0.01, 0.2},
                                                      {0.1, 0.03, 0},    {0.05, 0.02, 0.5}};
  static const std::vector<ConvolutionCase> wide = {
      {0.3, 0.01, 0.3}, {0.5, 0.02, 0.4}, {0.3, 0.04, 0.3}};
  static const std::vector<ConvolutionCase> longer = {
      {0.1, 0.02, 0}, {0.05, 0.02, 0.3}, {0.1, 0.01, 0.5}, {0.03, 0.03, 0.6}};
  // Up to a third of these Gaussians lies beyond the disk.
  static const std::vector<ConvolutionCase> cut = {
      {0.05, 0.02, 0.8}, {0.1, 0.01, 0.9}, {0.1, 0.03, 0.9}, {0.05, 0.005, 0.95}};
  return {{"lobe/convolution", "error over the brightest",
           [](const CheckContext& context) { return lobes(context, unlike, 0.04); }},
          {"lobe/convolution_wide", "error over the brightest",
           [](const CheckContext& context) { return lobes(context, wide, 0.1); }},
          {"lobe/convolution_rim", "error over the brightest",
           [](const CheckContext& context) { return lobes(context, cut, kRimLobes); }},
          {"lobe/mean_cosine", "error of the cosine", meanCosines},
          {"lobe/convolution_long", "error over the brightest",
           [](const CheckContext& context) { return longLobes(context, longer, kLongLobes); }},
          {"texture/parallelogram", "error of waves of 1",
           [](const CheckContext& context) { return footprints(context, 1, kOneRowBounds); }},
          {"texture/parallelogram_2_rows", "error of waves of 1",
           [](const CheckContext& context) { return footprints(context, 2, kTwoRowBounds); }},
          {"texture/parallelogram_4_rows", "error of waves of 1",
           [](const CheckContext& context) { return footprints(context, 4, kFourRowBounds); }}};
}

}  // namespace glintmark
