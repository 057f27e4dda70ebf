#include "host/mixture/mixture_level.h"

#include <algorithm>
#include <cmath>

#include "host/filter/interpolated_normals.h"

namespace glintmark {

ProjectedNormals::ProjectedNormals(const NormalMap& map)
    : width_px(map.width_px), height_px(map.height_px) {
  x.reserve(map.normals.size() + kBlockTexels);
  y.reserve(map.normals.size() + kBlockTexels);
  for (const glm::vec3& n : map.normals) {
    x.push_back(n.x);
    y.push_back(n.y);
  }
  x.resize(x.size() + kBlockTexels);
  y.resize(y.size() + kBlockTexels);
}

MixtureLevel::MixtureLevel(const ProjectedNormals& finest, int level)
    : finest_(finest),
      width_(std::max(1, finest.width_px >> level)),
      height_(std::max(1, finest.height_px >> level)),
      normals_per_texel_(static_cast<double>(finest.width_px) / width_ * finest.height_px /
                         height_) {
  for (int x = 0; x < width_; ++x) {
    columns_.push_back(mipCover(x, width_, finest.width_px));
    std::vector<float>& weights = columns_.back().weights;
    column_counts_.push_back(weights.size());
    most_columns_ = std::max(most_columns_, weights.size());
    weights.resize(weights.size() + kBlockTexels);
  }
  for (int y = 0; y < height_; ++y) {
    rows_.push_back(mipCover(y, height_, finest.height_px));
    most_rows_ = std::max(most_rows_, rows_.back().weights.size());
  }
}

void MixtureLevel::copyNormals(glm::ivec2 texel, int lane, float* x, float* y,
                               float* weight) const {
  const MipCover &column = columns_[texel.x], &row = rows_[texel.y];
  const std::size_t columns = column_counts_[texel.x];
  std::size_t to = lane, from = 0;
  for (std::size_t j = 0; j < row.weights.size(); ++j) {
    from = (row.first + j) * finest_.width_px + column.first;
    for (std::size_t i = 0; i < columns; ++i, ++from, to += kBlockTexels) {
      x[to] = finest_.x[from];
      y[to] = finest_.y[from];
      weight[to] = row.weights[j] * column.weights[i];
    }
  }
  for (const std::size_t end = mostNormals() * kBlockTexels; to < end; to += kBlockTexels) {
    x[to] = finest_.x[from - 1];
    y[to] = finest_.y[from - 1];
    weight[to] = 0;
  }
}

std::vector<NormalRow> MixtureLevel::rows(glm::ivec2 texel) const {
  const MipCover &column = columns_[texel.x], &row = rows_[texel.y];
  std::vector<NormalRow> result;
  result.reserve(row.weights.size());
  for (std::size_t j = 0; j < row.weights.size(); ++j) {
    const std::size_t from = (row.first + j) * finest_.width_px + column.first;
    result.push_back({finest_.x.data() + from, finest_.y.data() + from, column.weights.data(),
                      column_counts_[texel.x], row.weights[j]});
  }
  return result;
}

std::vector<WeightedNormal> MixtureLevel::sample(glm::ivec2 texel, std::size_t most) const {
  const MipCover &column = columns_[texel.x], &row = rows_[texel.y];
  const std::size_t columns = column_counts_[texel.x], rows = row.weights.size();
  std::vector<WeightedNormal> result;
  const auto add = [&](std::size_t i, std::size_t j) {
    const std::size_t from = (row.first + j) * finest_.width_px + column.first + i;
    result.push_back({{finest_.x[from], finest_.y[from]}, row.weights[j] * column.weights[i]});
  };
  if (columns * rows <= most) {
    for (std::size_t j = 0; j < rows; ++j) {
      for (std::size_t i = 0; i < columns; ++i) add(i, j);
    }
    return result;
  }
  // Roberts' R2 sequence: even, and in step with no pattern of the map as a lattice might be.
  for (std::size_t k = 0; k < most; ++k) {
    const double u = 0.7548776662466927 * static_cast<double>(k + 1);
    const double v = 0.5698402909980532 * static_cast<double>(k + 1);
    add(static_cast<std::size_t>((u - std::floor(u)) * static_cast<double>(columns)),
        static_cast<std::size_t>((v - std::floor(v)) * static_cast<double>(rows)));
  }
  return result;
}

FittedNormals::FittedNormals(const NormalMap& map, MixtureSurface surface) : texels_(map) {
  if (surface == MixtureSurface::kInterpolated && canInterpolate(map))
    between_.emplace(interpolatedNormals(map, kSurfaceSamples));
}

const ProjectedNormals& FittedNormals::normals(int level) const {
  return seesBetween(level) ? *between_ : texels_;
}

MixtureLevel FittedNormals::level(int level) const {
  // A map of twice the size has one level more.
  return {normals(level), seesBetween(level) ? level + 1 : level};
}

float FittedNormals::samplesPerTexel(int level) const {
  return seesBetween(level) ? static_cast<float>(kSurfaceSamples * kSurfaceSamples) : 1.0f;
}

}  // namespace glintmark
