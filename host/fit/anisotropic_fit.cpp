#include "host/fit/anisotropic_fit.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <mutex>

#include "host/fit/anisotropic_lobe.h"

namespace glintmark {
namespace {

// Times that every cell is fitted again from its neighbours' lobes.
constexpr int kAnisotropicRefinements = 1;

constexpr int kViews = ANISO_NODES * ANISO_NODES;     // by tilt and azimuth
constexpr int kSurfaces = ANISO_NODES * ANISO_NODES;  // by roughness and ratio
constexpr int kLastNode = ANISO_NODES - 1;

// Samples for the albedos, which are needed once per cell.
constexpr AnisotropicSampleCounts kAlbedoCounts = {.facet_radial = 96,
                                                   .facet_azimuth = 96,
                                                   .lobe_radial = 48,
                                                   .lobe_azimuth = 64,
                                                   .hemisphere_radial = 24,
                                                   .hemisphere_azimuth = 32};

class AnisotropicFit {
 public:
  explicit AnisotropicFit(const AnisotropicFitOptions& options)
      : options_(options), cells_(ANISO_CELLS) {}

  AnisotropicTable run() {
    overViews([this](int view) { fitView(view); });
    for (int pass = 0; pass < kAnisotropicRefinements; ++pass) {
      const std::vector<AnisotropicCell> before = cells_;
      overViews([&](int view) { refineView(before, view); });
    }
    overViews([this](int view) { addAlbedos(view); });
    AnisotropicTable table;
    table.ndf = options_.ndf;
    for (int i = 0; i < ANISO_CELLS; ++i) table.setCell(i, cells_[static_cast<std::size_t>(i)]);
    return table;
  }

 private:
  // Those of this rank; then all ranks have all cells.
  template <typename View>
  void overViews(const View& fit) {
    tbb::parallel_for(
        0, kViews,
        [&](int view) {
          if (!options_.ranks->makes(static_cast<std::size_t>(view))) return;
          fit(view);
          viewDone();
        },
        tbb::simple_partitioner());
    shareRows(*options_.ranks, std::span(cells_), static_cast<std::size_t>(kSurfaces));
  }

  static AnisotropicNode nodeOf(int view, int roughness, int ratio) {
    return {roughness, ratio, view % ANISO_NODES, view / ANISO_NODES};
  }

  AnisotropicCell& cell(const AnisotropicNode& node) {
    return cells_[static_cast<std::size_t>(anisotropicIndex(node))];
  }

  // The inverse of M that a neighbour's cell gives here.
  static glm::dmat3 startFrom(const AnisotropicCell& neighbour, const AnisotropicView& view) {
    return glm::inverse(anisotropicMatrix(neighbour, view));
  }

  void fit(const AnisotropicNode& node, std::span<const glm::dmat3> starts) {
    const AnisotropicView view = anisotropicView(options_.ndf, node);
    storeAnisotropic(glm::inverse(fitAnisotropicLobe(view, starts)), view, cell(node));
  }

  // From rough to smooth, from round to stretched: rough round lobes have one minimum.
  void fitView(int v) {
    for (int ratio = kLastNode; ratio >= 0; --ratio)
      for (int roughness = kLastNode; roughness >= 0; --roughness) {
        const AnisotropicNode node = nodeOf(v, roughness, ratio);
        const AnisotropicView view = anisotropicView(options_.ndf, node);
        std::vector<glm::dmat3> starts;
        if (roughness < kLastNode)
          starts.push_back(startFrom(cell(nodeOf(v, roughness + 1, ratio)), view));
        if (ratio < kLastNode)
          starts.push_back(startFrom(cell(nodeOf(v, roughness, ratio + 1)), view));
        if (starts.empty()) starts.push_back(glm::dmat3(1.0));
        fit(node, starts);
      }
  }

  void refineView(const std::vector<AnisotropicCell>& before, int v) {
    for (int ratio = 0; ratio < ANISO_NODES; ++ratio)
      for (int roughness = 0; roughness < ANISO_NODES; ++roughness) {
        const AnisotropicNode node = nodeOf(v, roughness, ratio);
        const AnisotropicView view = anisotropicView(options_.ndf, node);
        const auto startOf = [&](const AnisotropicNode& from) {
          return startFrom(before[static_cast<std::size_t>(anisotropicIndex(from))], view);
        };
        std::vector<glm::dmat3> starts = {startOf(node)};
        for (std::size_t axis = 0; axis < node.size(); ++axis)
          for (const int step : {-1, 1}) {
            AnisotropicNode from = node;
            from[axis] += step;
            if (from[axis] < 0 || from[axis] > kLastNode) continue;
            starts.push_back(startOf(from));
          }
        fit(node, starts);
      }
  }

  void addAlbedos(int v) {
    for (int ratio = 0; ratio < ANISO_NODES; ++ratio)
      for (int roughness = 0; roughness < ANISO_NODES; ++roughness) {
        const AnisotropicNode node = nodeOf(v, roughness, ratio);
        const AnisotropicView view = anisotropicView(options_.ndf, node);
        AnisotropicCell& here = cell(node);
        const AnisotropicSamples samples =
            makeAnisotropicSamples(view, startFrom(here, view), kAlbedoCounts);
        here.albedo = std::min(samples.albedo, 1.0);
        here.schlick_albedo = samples.schlick_albedo;
      }
  }

  void viewDone() {
    const std::scoped_lock lock(progress_mutex_);
    ++views_done_;
    if (options_.progress)
      options_.progress(std::min(
          1.0, views_done_ * options_.ranks->size() / ((2.0 + kAnisotropicRefinements) * kViews)));
  }

  const AnisotropicFitOptions& options_;
  std::vector<AnisotropicCell> cells_;
  std::mutex progress_mutex_;
  int views_done_ = 0;
};

}  // namespace

AnisotropicTable fitAnisotropicTable(const AnisotropicFitOptions& options) {
  tbb::task_arena arena(options.threads > 0 ? options.threads : tbb::task_arena::automatic);
  return arena.execute([&] { return AnisotropicFit(options).run(); });
}

}  // namespace glintmark
