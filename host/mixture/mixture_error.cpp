#include "host/mixture/mixture_error.h"

#include <cmath>
#include <numbers>
#include <random>

#include "host/filter/mip_chain.h"

namespace glintmark {
namespace {

using Lobes = std::vector<ReferenceLobe>;

// Appends the normals under a texel as lobes of no width, `weight` in all.
void appendNormals(const NormalMap& map, const NormalMixtures& mixtures, int level,
                   glm::ivec2 texel, double weight, Lobes& to) {
  const int width = mixtures.moments.levelWidth(level);
  const int height = mixtures.moments.levelHeight(level);
  const MipCover column = mipCover(texel.x, width, map.width_px);
  const MipCover row = mipCover(texel.y, height, map.height_px);
  const double area = static_cast<double>(map.width_px) / width * map.height_px / height;
  for (std::size_t j = 0; j < row.weights.size(); ++j) {
    for (std::size_t i = 0; i < column.weights.size(); ++i) {
      const glm::vec3& n =
          map.at(column.first + static_cast<int>(i), row.first + static_cast<int>(j));
      to.push_back({weight * row.weights[j] * column.weights[i] / area, {n.x, n.y}, 0});
    }
  }
}

// The mixture of four texels' lobes, each lobe index by itself.
Lobes mixTexels(const NormalMixtures& mixtures, int level, std::span<const glm::ivec2> texels) {
  Lobes result;
  for (int i = 0; i < mixtures.lobes; ++i) {
    float4 sum;
    const float share = 1.0f / static_cast<float>(texels.size());
    for (const glm::ivec2 t : texels) {
      const float4& m = mixtures.moments.at(level, t.x, t.y)[i];
      sum.x += share * m.x, sum.y += share * m.y, sum.z += share * m.z, sum.w += share * m.w;
    }
    const NormalLobe lobe = lobeFromMoments(sum);
    result.push_back({lobe.weight, glm::dvec2(lobe.mean), lobe.variance});
  }
  return result;
}

}  // namespace

double mixtureProduct(std::span<const ReferenceLobe> a, std::span<const ReferenceLobe> b,
                      double variance) {
  double sum = 0;
  for (const ReferenceLobe& p : a) {
    for (const ReferenceLobe& q : b) {
      const double v = p.variance + q.variance + 2 * variance;
      const glm::dvec2 d = p.mean - q.mean;
      sum += p.weight * q.weight * std::exp(-0.5 * glm::dot(d, d) / v) / v;
    }
  }
  return sum / (2 * std::numbers::pi);
}

double mixtureDistance(std::span<const ReferenceLobe> mixture, std::span<const ReferenceLobe> truth,
                       double variance) {
  const double norm = mixtureProduct(truth, truth, variance);
  const double squared = mixtureProduct(mixture, mixture, variance) -
                         2 * mixtureProduct(mixture, truth, variance) + norm;
  return std::max(0.0, squared) / norm;
}

InterpolationError measureInterpolation(const NormalMap& map, const NormalMixtures& mixtures,
                                        int level, int points, double deviation,
                                        std::uint32_t seed) {
  const int width = mixtures.moments.levelWidth(level);
  const int height = mixtures.moments.levelHeight(level);
  std::mt19937 random(seed);
  const auto distance = [&](std::span<const glm::ivec2> texels) {
    Lobes truth;
    for (const glm::ivec2 t : texels) {
      appendNormals(map, mixtures, level, t, 1.0 / static_cast<double>(texels.size()), truth);
    }
    return mixtureDistance(mixTexels(mixtures, level, texels), truth, deviation * deviation);
  };
  double fitted = 0, interpolated = 0;
  for (int point = 0; point < points; ++point) {
    const glm::ivec2 t(random() % static_cast<unsigned>(width),
                       random() % static_cast<unsigned>(height));
    const glm::ivec2 next((t.x + 1) % width, (t.y + 1) % height);
    const glm::ivec2 corner[] = {t, {next.x, t.y}, {t.x, next.y}, next};
    fitted += distance({corner, 1});
    interpolated += distance(corner);
  }
  return {std::sqrt(fitted / points), std::sqrt(interpolated / points)};
}

double measureMisalignment(const NormalMixtures& mixtures, int level) {
  const int width = mixtures.moments.levelWidth(level);
  const int height = mixtures.moments.levelHeight(level);
  const auto added_spread = [&](const float4* p, const float4* q) {
    double sum = 0;
    for (int i = 0; i < mixtures.lobes; ++i) {
      const double a = p[i].x, b = q[i].x;
      if (a <= 0 || b <= 0) continue;
      const double dx = p[i].y / a - q[i].y / b, dy = p[i].z / a - q[i].z / b;
      sum += 0.5 * a * b / (a + b) * (dx * dx + dy * dy);
    }
    return sum;
  };
  double sum = 0, pairs = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float4* own = mixtures.moments.at(level, x, y);
      if (x + 1 < width) sum += added_spread(own, mixtures.moments.at(level, x + 1, y)), ++pairs;
      if (y + 1 < height) sum += added_spread(own, mixtures.moments.at(level, x, y + 1)), ++pairs;
    }
  }
  return pairs > 0 ? std::sqrt(sum / pairs) : 0;
}

}  // namespace glintmark
