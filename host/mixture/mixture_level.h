// The finest normals as the fit reads them, and what a level's texels cover of them.
#pragma once
#include <optional>
#include <vector>

#include "host/filter/mip_chain.h"
#include "host/mixture/mixture_em.h"
#include "host/mixture/mixture_start.h"
#include "host/mixture/normal_mixture.h"

namespace glintmark {

/// Normals projected onto the tangent plane, row by row, readable kBlockTexels past the end.
struct ProjectedNormals {
  int width_px = 0, height_px = 0;
  std::vector<float> x, y;

  explicit ProjectedNormals(const NormalMap& map);
};

/// One level of the chain over the finest normals.
class MixtureLevel {
 public:
  MixtureLevel(const ProjectedNormals& finest, int level);

  int width() const { return width_; }
  int height() const { return height_; }
  std::size_t texelCount() const { return static_cast<std::size_t>(width_) * height_; }
  /// Weight of the normals under each texel: texels of the finest level.
  double normalsPerTexel() const { return normals_per_texel_; }
  /// Whether rows under a texel are long enough to fill vectors with them.
  bool hasLongRows() const { return most_columns_ >= kBlockTexels; }
  /// Most normals under any texel.
  std::size_t mostNormals() const { return most_columns_ * most_rows_; }

  /// Copies the normals under `texel` to lane `lane` of arrays laid out as BlockNormals; entries
  /// beyond the texel's own up to mostNormals() repeat its last one with weight 0.
  void copyNormals(glm::ivec2 texel, int lane, float* x, float* y, float* weight) const;
  /// The rows of normals under `texel`.
  std::vector<NormalRow> rows(glm::ivec2 texel) const;
  /// The normals under `texel`, or `most` of them, evenly spread, for a clustered start.
  std::vector<WeightedNormal> sample(glm::ivec2 texel, std::size_t most) const;

 private:
  const ProjectedNormals& finest_;
  int width_, height_;
  double normals_per_texel_;
  std::vector<MipCover> columns_, rows_;  // weights padded by kBlockTexels zeros in columns_
  std::vector<std::size_t> column_counts_;
  std::size_t most_columns_ = 0, most_rows_ = 0;
};

/// The normals that a chain of mixtures stands for, level by level.
class FittedNormals {
 public:
  FittedNormals(const NormalMap& map, MixtureSurface surface);

  /// What the texels of `level` of the map's chain cover. Refers to this object.
  MixtureLevel level(int level) const;
  /// The normals that the level covers.
  const ProjectedNormals& normals(int level) const;
  /// Of them, how many lie under a texel of the map, 1 or more.
  float samplesPerTexel(int level) const;

 private:
  bool seesBetween(int level) const { return between_ && level > 0; }

  ProjectedNormals texels_;
  std::optional<ProjectedNormals> between_;  // the map interpolated, if the surface is
};

}  // namespace glintmark
