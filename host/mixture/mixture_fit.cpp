// The fit of a whole chain: levels, sweeps, batches, blocks. [TAN05] Sect. 4.1
#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>

#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/core/stopwatch.h"
#include "host/filter/interpolated_normals.h"
#include "host/mixture/mixture_em.h"
#include "host/mixture/mixture_fit_types.h"
#include "host/mixture/mixture_level.h"
#include "host/mixture/mixture_order.h"
#include "host/mixture/mixture_sharing.h"
#include "host/mixture/mixture_start.h"
#include "host/mixture/normal_mixture.h"
#include "host/mixture/shared_mixture_fit.h"

namespace glintmark {
namespace {

// Normals that one task adds up in single precision before the sums continue in double.
constexpr std::size_t kTaskNormals = 16384;
// Blocks per task.
constexpr int kGrain = 8;
// Normals between two calls of the progress, about half a second of one processor.
constexpr double kNormalsPerCall = 1 << 22;

// Sums over the texels of a level.
struct Tally {
  double iterations = 0, converged = 0, log_likelihood = 0;
  Tally& operator+=(const Tally& o) {
    iterations += o.iterations, converged += o.converged, log_likelihood += o.log_likelihood;
    return *this;
  }
};

// Normals of the block in hand.
struct Scratch {
  std::vector<float> x, y, weight;
  void reserve(std::size_t normals) {
    const std::size_t size = normals * kBlockTexels;
    if (x.size() < size) x.resize(size), y.resize(size), weight.resize(size);
  }
  BlockNormals view(std::size_t normals) const {
    return {x.data(), y.data(), weight.data(), normals};
  }
};

// Up to kBlockTexels consecutive texels of a batch; lanes beyond `count` repeat the last one.
struct BlockTexels {
  const TexelBatch& batch;
  int first, count;
  glm::ivec2 at(int lane) const { return batch.at(first + std::min(lane, count - 1)); }
};

class MixtureFit {
 public:
  MixtureFit(const Ranks& ranks, const NormalMap& map, const MixtureOptions& options,
             const std::function<void(double)>& progress)
      : ranks_(ranks), options_(options), progress_(progress), normals_(map, options.surface) {
    result_.moments = makeMipTexels(map.width_px, map.height_px, options.lobes);
    result_.lobes = options.lobes;
    level_count_ = static_cast<int>(result_.moments.layout.level_count);
    result_.levels.resize(level_count_);
  }

  NormalMixtures run() {
    const Stopwatch watch;
    for (int pass = 0; pass < options_.passes; ++pass) {
      for (int level = level_count_ - 1; level >= 0; --level) fitLevel(level, pass);
    }
    for (int level = 0; level < level_count_; ++level) finishLevel(level);
    result_.fit_ms = watch.elapsedNs() * 1e-6;
    return std::move(result_);
  }

 private:
  // While fitting, a lobe's float4 is (weight, mean.x, mean.y, variance).
  float4* state(int level, glm::ivec2 texel) { return result_.moments.at(level, texel.x, texel.y); }

  // What of the neighbourhood has been fitted before a texel is: nothing of its own level in the
  // first sweep, finer levels only in a later pass.
  struct Round {
    int level = 0;
    bool first_sweep = true, first_pass = true;
  };

  void fitLevel(int level, int pass) {
    const MixtureLevel geometry = normals_.level(level);
    Tally tally;
    const std::vector<TexelBatch> batches =
        texelBatches(options_.order, geometry.width(), geometry.height());
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      tally.converged = 0;
      const Round round{level, pass == 0 && sweep == 0, pass == 0};
      for (const TexelBatch& batch : batches) {
        tally += overBlocks(geometry, level, batch, [&](const BlockTexels& texels) {
          return fitBlock(geometry, round, texels);
        });
      }
    }
    MixtureLevelReport& report = result_.levels[level];
    const auto texels = static_cast<double>(geometry.texelCount());
    report.width_px = geometry.width(), report.height_px = geometry.height();
    report.mean_iterations += tally.iterations / texels;
    report.converged_share = tally.converged / texels;
  }

  void finishLevel(int level) {
    const MixtureLevel geometry = normals_.level(level);
    const TexelBatch all =
        texelBatches(MixtureOrder::kIndependent, geometry.width(), geometry.height()).front();
    const Tally tally = overBlocks(geometry, level, all, [&](const BlockTexels& texels) {
      return finishBlock(geometry, level, texels);
    });
    result_.levels[level].log_likelihood =
        tally.log_likelihood /
        (geometry.normalsPerTexel() * static_cast<double>(geometry.texelCount()));
  }

  // By a share of one sweep over a level; levels take about as long as each other.
  void advance(double share) {
    done_ += share;
    const double all = (options_.passes * options_.sweeps + 1.0) * level_count_;
    if (progress_) progress_(std::min(1.0, done_ / all));
  }

  // Calls `run` for every block of the batch, a texel a block where rows are long; adds up tallies
  // in an order that does not depend on the threads or the ranks.
  template <class Run>
  Tally overBlocks(const MixtureLevel& geometry, int level, const TexelBatch& batch,
                   const Run& run) {
    const int size = geometry.hasLongRows() ? 1 : kBlockTexels;
    const int blocks = (batch.count + size - 1) / size;
    const auto texels = [&](int b) {
      return BlockTexels{batch, b * size, std::min(size, batch.count - b * size)};
    };
    std::vector<Tally> made;  // where ranks have a part in it
    sharing_ = mixtureSharing(ranks_, geometry, blocks);
    if (sharing_ == MixtureSharing::kNormals) {
      // One after the other: every rank takes part in each.
      for (int b = 0; b < blocks; ++b) made.push_back(run(texels(b)));
    } else if (sharing_ == MixtureSharing::kBlocks) {
      made.resize(static_cast<std::size_t>(blocks));
      tbb::parallel_for(0, blocks, [&](int b) {
        if (ranks_.makes(static_cast<std::size_t>(b)))
          made[static_cast<std::size_t>(b)] = run(texels(b));
      });
      shareRows(ranks_, std::span(made), 1);
      shareStates(level, batch, size);
    }
    const int per_call = std::max(
        1, static_cast<int>(kNormalsPerCall / std::max(1.0, size * geometry.normalsPerTexel())));
    Tally sum;
    for (int first = 0; first < blocks; first += std::min(per_call, blocks - first)) {
      const int last = first + std::min(per_call, blocks - first);
      sum += tbb::parallel_deterministic_reduce(
          tbb::blocked_range<int>(first, last, geometry.hasLongRows() ? 1 : kGrain), Tally{},
          [&](const tbb::blocked_range<int>& range, Tally tally) {
            for (int b = range.begin(); b < range.end(); ++b)
              tally += made.empty() ? run(texels(b)) : made[static_cast<std::size_t>(b)];
            return tally;
          },
          [](Tally a, const Tally& b) { return a += b; });
      advance((last - first) * static_cast<double>(size) /
              static_cast<double>(geometry.texelCount()));
    }
    return sum;
  }

  // Of all ranks: mixtures of the batch's texels, each block from the rank that has fitted it.
  void shareStates(int level, const TexelBatch& batch, int size) {
    shareParts(
        ranks_, static_cast<std::size_t>(batch.count),
        [&](std::size_t i) { return i / static_cast<std::size_t>(size); },
        [&](std::size_t i) {
          return std::span(reinterpret_cast<char*>(state(level, batch.at(static_cast<int>(i)))),
                           static_cast<std::size_t>(options_.lobes) * sizeof(float4));
        });
  }

  // E-step of the block's texels.
  void expect(const MixtureLevel& geometry, const BlockTexels& texels, const Scratch& scratch,
              bool likelihood, MixtureBlock& block) {
    if (!geometry.hasLongRows()) {
      expectBlock(block, options_.lobes, scratch.view(geometry.mostNormals()), likelihood);
      return;
    }
    expectLongRows(geometry.rows(texels.at(0)),
                   sharing_ == MixtureSharing::kNormals ? ranks_ : aloneRanks(), likelihood, block);
  }

  // Of all `ranks`.
  void expectLongRows(const std::vector<NormalRow>& rows, const Ranks& ranks, bool likelihood,
                      MixtureBlock& block) {
    const std::size_t rows_per_task = std::max<std::size_t>(1, kTaskNormals / rows[0].count);
    const std::size_t tasks = (rows.size() + rows_per_task - 1) / rows_per_task;
    using Totals = double[kMaxLobes + 1][4];
    const auto totals = std::make_unique<Totals[]>(tasks);
    tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
      if (!ranks.makes(task)) return;
      const std::size_t first = task * rows_per_task;
      expectRows(block, options_.lobes, rows.data() + first,
                 std::min(rows_per_task, rows.size() - first), likelihood, totals[task]);
    });
    constexpr std::size_t kNumbers = sizeof(Totals) / sizeof(double);
    shareRows(ranks, std::span(&totals[0][0][0], tasks * kNumbers), kNumbers);
    for (std::size_t task = 1; task < tasks; ++task) {
      for (int i = 0; i <= options_.lobes; ++i) {
        for (int k = 0; k < 4; ++k) totals[0][i][k] += totals[task][i][k];
      }
    }
    for (int i = 0; i < options_.lobes; ++i) {
      block.sum[i][0] = static_cast<float>(totals[0][i][0]);
      block.sum_x[i][0] = static_cast<float>(totals[0][i][1]);
      block.sum_y[i][0] = static_cast<float>(totals[0][i][2]);
      block.sum_squares[i][0] = static_cast<float>(totals[0][i][3]);
    }
    block.log_likelihood[0] = static_cast<float>(totals[0][options_.lobes][0]);
  }

  // Normals of the block's texels, where lanes hold texels.
  const Scratch& gather(const MixtureLevel& geometry, const BlockTexels& texels) {
    Scratch& scratch = scratch_.local();
    if (geometry.hasLongRows()) return scratch;
    scratch.reserve(geometry.mostNormals());
    for (int lane = 0; lane < kBlockTexels; ++lane) {
      geometry.copyNormals(texels.at(lane), lane, scratch.x.data(), scratch.y.data(),
                           scratch.weight.data());
    }
    return scratch;
  }

  Tally fitBlock(const MixtureLevel& geometry, const Round& round, const BlockTexels& texels) {
    MixtureBlock block{};
    std::ranges::fill(block.normals, static_cast<float>(geometry.normalsPerTexel()));
    for (int lane = 0; lane < kBlockTexels; ++lane) {
      // Lanes beyond the block hold a copy of its last texel, whose result is not stored.
      if (lane >= texels.count && geometry.hasLongRows()) {
        for (int i = 0; i < options_.lobes; ++i) block.variance[i][lane] = 1;
        continue;
      }
      start(geometry, round, texels.at(lane), lane, block);
      addNeighbours(geometry, round, texels.at(lane), lane, block);
    }
    const Scratch& scratch = gather(geometry, texels);
    const auto resting = [&](int lane) { return block.moved[lane] < options_.tolerance; };
    int iterations = 0, converged = 0;
    const bool root = round.first_sweep && round.level == level_count_ - 1;
    const int limit =
        root ? std::max(MF_ROOT_ITERATIONS, options_.max_iterations) : options_.max_iterations;
    while (iterations < limit && converged < texels.count) {
      expect(geometry, texels, scratch, false, block);
      maximizeBlock(block, options_.lobes);
      ++iterations;
      converged = 0;
      for (int lane = 0; lane < texels.count; ++lane) converged += resting(lane);
    }
    for (int lane = 0; lane < texels.count; ++lane) {
      float4* lobes = state(round.level, texels.at(lane));
      for (int i = 0; i < options_.lobes; ++i) {
        lobes[i] = {block.weight[i][lane], block.mean_x[i][lane], block.mean_y[i][lane],
                    block.variance[i][lane]};
      }
    }
    return {static_cast<double>(iterations) * texels.count, static_cast<double>(converged), 0};
  }

  // The mixture a texel begins with: its own from the last sweep, its parent's, or clusters.
  void start(const MixtureLevel& geometry, const Round& round, glm::ivec2 texel, int lane,
             MixtureBlock& block) {
    const bool clustered =
        options_.order == MixtureOrder::kIndependent || round.level == level_count_ - 1;
    if (round.first_sweep && clustered) {
      const auto clusters =
          clusterNormals(geometry.sample(texel, MF_START_NORMALS), options_.lobes);
      for (int i = 0; i < options_.lobes; ++i) {
        const NormalLobe& c = clusters[i];
        setLobe(block, i, lane, {c.weight, c.mean.x, c.mean.y, c.variance}, 0);
      }
      return;
    }
    const float4* from =
        round.first_sweep ? parent(geometry, round.level, texel) : state(round.level, texel);
    for (int i = 0; i < options_.lobes; ++i) {
      setLobe(block, i, lane, from[i], round.first_sweep ? MF_START_MIX : 0);
    }
  }

  void setLobe(MixtureBlock& block, int i, int lane, const float4& lobe, float mix) {
    block.weight[i][lane] = lobe.x + mix * (1.0f / static_cast<float>(options_.lobes) - lobe.x);
    block.mean_x[i][lane] = lobe.y;
    block.mean_y[i][lane] = lobe.z;
    block.variance[i][lane] = std::max(lobe.w, MF_MIN_VARIANCE);
  }

  const float4* parent(const MixtureLevel& geometry, int level, glm::ivec2 texel) {
    const int width = result_.moments.levelWidth(level + 1);
    const int height = result_.moments.levelHeight(level + 1);
    return state(level + 1, {texel.x * static_cast<std::int64_t>(width) / geometry.width(),
                             texel.y * static_cast<std::int64_t>(height) / geometry.height()});
  }

  // Sums C a_k and C a_k mean_k over the parent, the visible neighbours of the same level, and,
  // once they are fitted, the four finer texels.
  void addNeighbours(const MixtureLevel& geometry, const Round& round, glm::ivec2 texel, int lane,
                     MixtureBlock& block) {
    if (options_.order == MixtureOrder::kIndependent) return;
    const float prior_weight = options_.prior_weight * normals_.samplesPerTexel(round.level);
    const auto add = [&](const float4* lobes) {
      for (int i = 0; i < options_.lobes; ++i) {
        const float weight = prior_weight * lobes[i].x;
        block.prior_weight[i][lane] += weight;
        block.prior_x[i][lane] += weight * lobes[i].y;
        block.prior_y[i][lane] += weight * lobes[i].z;
      }
    };
    const int level = round.level;
    if (level + 1 < level_count_) add(parent(geometry, level, texel));
    const Neighbours neighbours = visibleNeighbours(options_.order, round.first_sweep, texel,
                                                    geometry.width(), geometry.height());
    for (int k = 0; k < neighbours.count; ++k) add(state(level, neighbours.texels[k]));
    if (round.first_pass || level == 0) return;
    const int width = result_.moments.levelWidth(level - 1);
    const int height = result_.moments.levelHeight(level - 1);
    // A side of one texel stays one: the same finer texel does not count twice.
    for (int y = 2 * texel.y; y < std::min(2 * texel.y + 2, height); ++y) {
      for (int x = 2 * texel.x; x < std::min(2 * texel.x + 2, width); ++x) {
        add(state(level - 1, {x, y}));
      }
    }
  }

  // One more E-step, and an M-step without prior: moments become those of the normals.
  Tally finishBlock(const MixtureLevel& geometry, int level, const BlockTexels& texels) {
    MixtureBlock block{};
    std::ranges::fill(block.normals, static_cast<float>(geometry.normalsPerTexel()));
    for (int lane = 0; lane < kBlockTexels; ++lane) {
      const float4* lobes = state(level, texels.at(lane));
      for (int i = 0; i < options_.lobes; ++i) {
        setLobe(block, i, lane, lobes[i], 0);
        if (lobes[i].x < MF_LEAST_WEIGHT) block.weight[i][lane] = 0;
      }
    }
    expect(geometry, texels, gather(geometry, texels), true, block);
    Tally tally;
    for (int lane = 0; lane < texels.count; ++lane) {
      storeMoments(block, lane, state(level, texels.at(lane)));
      tally.log_likelihood += block.log_likelihood[lane];
    }
    return tally;
  }

  void storeMoments(const MixtureBlock& block, int lane, float4* to) const {
    double normals = 0;
    for (int i = 0; i < options_.lobes; ++i) normals += block.sum[i][lane];
    for (int i = 0; i < options_.lobes; ++i) {
      const double sum = block.sum[i][lane];
      const double mean_x = block.mean_x[i][lane], mean_y = block.mean_y[i][lane];
      const double dx = block.sum_x[i][lane], dy = block.sum_y[i][lane];
      const double squares = block.sum_squares[i][lane] + 2 * (mean_x * dx + mean_y * dy) +
                             sum * (mean_x * mean_x + mean_y * mean_y);
      to[i] = {static_cast<float>(sum / normals), static_cast<float>((sum * mean_x + dx) / normals),
               static_cast<float>((sum * mean_y + dy) / normals),
               static_cast<float>(squares / normals)};
    }
  }

  const Ranks& ranks_;
  const MixtureOptions options_;
  const std::function<void(double)>& progress_;
  const FittedNormals normals_;
  NormalMixtures result_;
  int level_count_ = 0;
  double done_ = 0;                                    // sweeps over levels
  MixtureSharing sharing_ = MixtureSharing::kNothing;  // of the batch in hand
  tbb::enumerable_thread_specific<Scratch> scratch_;
};

}  // namespace

std::uint64_t mixtureFitBytes(int width_px, int height_px, const MixtureOptions& options) {
  // The chain of mixtures, projected normals, and what lies between those.
  const std::uint64_t between =
      options.surface == MixtureSurface::kInterpolated && canInterpolate(width_px, height_px)
          ? kSurfaceSamples * kSurfaceSamples
          : 0;
  const std::uint64_t texel = static_cast<std::uint64_t>(options.lobes) * sizeof(float4) * 4 / 3 +
                              (1 + between) * sizeof(glm::vec2);
  return static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(height_px) * texel;
}

NormalMixtures fitNormalMixtures(const NormalMap& map, const MixtureOptions& options,
                                 const std::function<void(double)>& progress) {
  return fitMixturesShared(aloneRanks(), map, options, progress);
}

NormalMixtures fitMixturesShared(const Ranks& ranks, const NormalMap& map,
                                 const MixtureOptions& options,
                                 const std::function<void(double)>& progress) {
  checkMixtureOptions(options);
  checkNormalMap(map);
  requireMemory(mixtureFitBytes(map.width_px, map.height_px, options),
                fmt::format("a fit of {} lobes to each of the {}x{} texels of map '{}'",
                            options.lobes, map.width_px, map.height_px, map.name));
  tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : options.threads);
  return arena.execute([&] { return MixtureFit(ranks, map, options, progress).run(); });
}

}  // namespace glintmark
