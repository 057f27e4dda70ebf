#include "host/mixture/device_mixture_fit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <span>

#include "host/core/error.h"
#include "host/core/stopwatch.h"
#include "host/mixture/mixture_fit_types.h"
#include "host/mixture/mixture_level.h"
#include "host/mixture/mixture_order.h"

namespace glintmark {
namespace {

// Of one chunk of rows: enough to outweigh its sums being stored, few enough to fill a GPU. A texel
// has at most so many chunks, since they are added one after the other.
constexpr std::size_t kChunkNormals = 1024, kMostChunks = 256;
constexpr std::size_t kCpuLocalSize = 8, kGpuLocalSize = 64;
constexpr std::size_t kTallyPairs = 64;

int divideUp(std::size_t a, std::size_t b) {
  return static_cast<int>((a + b - 1) / b);
}

// Sizes of a level, and how its normals are shared out.
struct Level {
  int number = 0;
  const ProjectedNormals* normals = nullptr;  // that its texels cover
  int most_columns = 0, most_rows = 0;        // of them under one texel
  bool long_rows = false;                     // a lane is a normal, not a texel
  std::vector<TexelBatch> batches;
  std::vector<MixtureFitRun> runs;  // one per batch

  std::size_t mostTexels() const { return static_cast<std::size_t>(batches.front().count); }
};

// Projected normals on the device.
struct NormalBuffers {
  Buffer x, y;
};

class DeviceMixtureFit {
 public:
  DeviceMixtureFit(Device& device, ProgramCache& cache, int lanes, const NormalMap& map,
                   const MixtureOptions& options, const std::function<void(double)>& progress)
      : device_(device),
        lanes_(lanes),
        options_(options),
        progress_(progress),
        normals_(map, options.surface),
        local_size_(device.info().is_cpu ? kCpuLocalSize : kGpuLocalSize) {
    result_.moments = makeMipTexels(map.width_px, map.height_px, options_.lobes);
    result_.lobes = options_.lobes;
    for (uint level = 0; level < result_.moments.layout.level_count; ++level) {
      levels_.push_back(makeLevel(static_cast<int>(level)));
    }
    result_.levels.resize(levels_.size());
    const std::size_t words = result_.moments.texels.size() * 4;
    if (words > std::numeric_limits<std::int32_t>::max()) {
      throw Error(
          fmt::format("mixtures of {} lobes of a {}x{} map are too large for the fit on the"
                      " device; fit them on the host",
                      options_.lobes, map.width_px, map.height_px));
    }
    makeKernels(cache);
    makeBuffers();
  }

  NormalMixtures run() {
    const Stopwatch watch;
    upload();
    for (int pass = 0; pass < options_.passes; ++pass) {
      for (std::size_t level = levels_.size(); level-- > 0;) fitLevel(levels_[level], pass);
    }
    for (Level& level : levels_) finishLevel(level);
    LargeArray<float4>& texels = result_.moments.texels;
    state_.read(texels.data(), texels.size() * sizeof(float4));
    result_.fit_ms = watch.elapsedNs() * 1e-6;
    return std::move(result_);
  }

 private:
  Level makeLevel(int number) const {
    const MipTexels& moments = result_.moments;
    const int width = moments.levelWidth(number), height = moments.levelHeight(number);
    Level level;
    level.number = number;
    level.normals = &normals_.normals(number);
    const int columns = level.normals->width_px, rows = level.normals->height_px;
    for (int x = 0; x < width; ++x) {
      level.most_columns = std::max(level.most_columns,
                                    static_cast<int>(mipCover(x, width, columns).weights.size()));
    }
    for (int y = 0; y < height; ++y) {
      level.most_rows =
          std::max(level.most_rows, static_cast<int>(mipCover(y, height, rows).weights.size()));
    }
    level.long_rows = level.most_columns >= MF_SLOTS;
    level.batches = texelBatches(options_.order, width, height);
    for (const TexelBatch& batch : level.batches) level.runs.push_back(makeRun(level, batch));
    return level;
  }

  MixtureFitRun makeRun(const Level& level, const TexelBatch& batch) const {
    const MipTexels& moments = result_.moments;
    MixtureFitRun run{};
    const auto place = [&](int number, int& first, int& width, int& height) {
      if (number < 0 || number >= static_cast<int>(moments.layout.level_count)) return;
      first = static_cast<int>(moments.layout.first[number]);
      width = moments.levelWidth(number), height = moments.levelHeight(number);
    };
    place(level.number, run.first, run.width, run.height);
    place(level.number + 1, run.parent_first, run.parent_width, run.parent_height);
    run.map_width = level.normals->width_px, run.map_height = level.normals->height_px;
    run.most_columns = level.most_columns;
    run.origin_x = batch.origin.x, run.origin_y = batch.origin.y;
    run.columns = batch.per_row, run.rows = batch.count / batch.per_row;
    run.items_per_row = divideUp(static_cast<std::size_t>(run.columns), lanes_);
    const int rows_per_chunk =
        std::max(divideUp(kChunkNormals, level.most_columns),
                 divideUp(static_cast<std::size_t>(level.most_rows), kMostChunks));
    run.chunks = divideUp(static_cast<std::size_t>(level.most_rows), rows_per_chunk);
    run.rows_per_chunk = rows_per_chunk;
    run.prior_weight = options_.prior_weight * normals_.samplesPerTexel(level.number);
    run.tolerance = options_.tolerance;
    run.normals = static_cast<float>(static_cast<double>(run.map_width) / run.width *
                                     run.map_height / run.height);
    return run;
  }

  void makeKernels(ProgramCache& cache) {
    const Program program = cache.getWithOptions(
        "mixture/mixture_fit.cl", fmt::format("-D WIDTH={} -D LOBES={}", lanes_, options_.lobes));
    fit_texels_ = program.kernel("fitTexels");
    finish_texels_ = program.kernel("finishTexels");
    start_texels_ = program.kernel("startTexels");
    expect_rows_ = program.kernel("expectRows");
    add_partials_ = program.kernel("addPartials");
    maximize_texels_ = program.kernel("maximizeTexels");
    finish_rows_ = program.kernel("finishRows");
  }

  void makeBuffers() {
    const auto words = [&](std::size_t count, const char* what) {
      return Buffer(device_, count * 4, BufferPurpose::kMixtureFit, what);
    };
    for (const Level& level : levels_) {
      if (normal_buffers_.contains(level.normals)) continue;
      const std::size_t normals = level.normals->x.size();
      normal_buffers_[level.normals] = {words(normals, "the map's normals"),
                                        words(normals, "the map's normals")};
    }
    state_ = words(result_.moments.texels.size() * 4, "the mixtures");
    run_ =
        Buffer(device_, sizeof(MixtureFitRun), BufferPurpose::kMixtureFit, "the fit's parameters");
    tally_ = words(2 * kTallyPairs, "the fit's tally");
    const MipTexture& layout = result_.moments.layout;
    likelihood_ =
        words(static_cast<std::size_t>(layout.width) * layout.height, "the mixtures' likelihood");
    const std::size_t sums = MF_SUMS(options_.lobes);
    std::size_t texels = 1, parts = 1;
    for (const Level& level : levels_) {
      if (!level.long_rows) continue;
      texels = std::max(texels, level.mostTexels());
      parts = std::max(parts, level.mostTexels() * level.runs.front().chunks);
    }
    partials_ = words(parts * sums * MF_SLOTS, "the fit's partial sums");
    sums_ = words(texels * sums, "the fit's sums");
    prior_ = words(texels * 3 * options_.lobes, "the fit's priors");
    status_ = words(texels, "the fit's status");
  }

  // The map, and the coarsest texel's clusters.
  void upload() {
    for (auto& [normals, buffers] : normal_buffers_) {
      buffers.x.write(normals->x.data(), buffers.x.bytes());
      buffers.y.write(normals->y.data(), buffers.y.bytes());
    }
    const int root = static_cast<int>(levels_.size()) - 1;
    const MixtureLevel geometry = normals_.level(root);
    std::vector<float4> lobes;
    for (const NormalLobe& c :
         clusterNormals(geometry.sample({0, 0}, MF_START_NORMALS), options_.lobes)) {
      lobes.push_back({c.weight, c.mean.x, c.mean.y, c.variance});
    }
    const std::size_t first = result_.moments.layout.first[root];
    state_.write(lobes.data(), lobes.size() * sizeof(float4),
                 first * lobes.size() * sizeof(float4));
  }

  void launch(Kernel& kernel, std::vector<KernelArg> args, std::size_t items) {
    kernel.launch(args, items, local_size_);
  }

  static std::size_t items(const MixtureFitRun& run) {
    return static_cast<std::size_t>(run.rows) * run.items_per_row;
  }

  // EM steps, and texels at rest, of one batch.
  struct Tally {
    double steps = 0, resting = 0;
  };

  void fitLevel(Level& level, int pass) {
    MixtureLevelReport& report = result_.levels[level.number];
    const MixtureFitRun& any = level.runs.front();
    report.width_px = any.width, report.height_px = any.height;
    const double texels = static_cast<double>(any.width) * any.height;
    for (int sweep = 0; sweep < options_.sweeps; ++sweep) {
      Tally tally;
      const bool first = pass == 0 && sweep == 0;
      const bool root = any.parent_width == 0;
      for (MixtureFitRun run : level.runs) {
        run.first_sweep = first;
        run.from_parent = first && !root;
        run.max_iterations = first && root ? std::max(MF_ROOT_ITERATIONS, options_.max_iterations)
                                           : options_.max_iterations;
        if (pass > 0 && level.number > 0) {
          const MixtureFitRun& finer = levels_[level.number - 1].runs.front();
          run.finer_first = finer.first;
          run.finer_width = finer.width, run.finer_height = finer.height;
        }
        run_.write(&run, sizeof run);
        const Tally of_batch = level.long_rows ? fitRows(level, run) : fitTexels(level, run);
        tally.steps += of_batch.steps, tally.resting += of_batch.resting;
      }
      report.mean_iterations += tally.steps / texels;
      report.converged_share = tally.resting / texels;
    }
    advance();
  }

  const NormalBuffers& normalsOf(const Level& level) const {
    return normal_buffers_.at(level.normals);
  }

  Tally fitTexels(const Level& level, const MixtureFitRun& run) {
    tally_.fillZero();
    const NormalBuffers& normals = normalsOf(level);
    launch(fit_texels_, {normals.x, normals.y, run_, state_, tally_}, items(run));
    std::vector<std::uint32_t> counts(2 * kTallyPairs);
    tally_.read(counts.data(), counts.size() * 4);
    Tally tally;
    for (std::size_t i = 0; i < kTallyPairs; ++i) {
      tally.steps += counts[2 * i], tally.resting += counts[2 * i + 1];
    }
    return tally;
  }

  Tally fitRows(const Level& level, const MixtureFitRun& run) {
    launch(start_texels_, {run_, state_, prior_, status_}, items(run));
    std::vector<std::uint32_t> status(static_cast<std::size_t>(run.rows) * run.columns);
    std::size_t moving = status.size();
    for (int step = 0; step < run.max_iterations && moving > 0; ++step) {
      expectRows(level, run, false);
      launch(maximize_texels_, {run_, sums_, prior_, state_, status_}, items(run));
      status_.read(status.data(), status.size() * 4);
      moving = std::ranges::count_if(status, [](std::uint32_t s) { return (s & 1) != 0; });
    }
    Tally tally{0, static_cast<double>(status.size() - moving)};
    for (const std::uint32_t s : status) tally.steps += s >> 1;
    return tally;
  }

  void expectRows(const Level& level, const MixtureFitRun& run, bool finishing) {
    const NormalBuffers& normals = normalsOf(level);
    const std::size_t texels = static_cast<std::size_t>(run.rows) * run.columns;
    launch(expect_rows_,
           {normals.x, normals.y, run_, state_, status_, std::uint32_t{finishing}, partials_},
           texels * run.chunks * (MF_SLOTS / lanes_));
    launch(add_partials_, {run_, partials_, sums_}, texels * MF_SUMS(options_.lobes));
  }

  void finishLevel(Level& level) {
    const MixtureFitRun& any = level.runs.front();
    for (const MixtureFitRun& run : level.runs) {
      run_.write(&run, sizeof run);
      if (level.long_rows) {
        expectRows(level, run, true);
        launch(finish_rows_, {run_, sums_, state_, likelihood_}, items(run));
      } else {
        const NormalBuffers& normals = normalsOf(level);
        launch(finish_texels_, {normals.x, normals.y, run_, state_, likelihood_}, items(run));
      }
    }
    std::vector<float> likelihood(static_cast<std::size_t>(any.width) * any.height);
    likelihood_.read(likelihood.data(), likelihood.size() * 4);
    result_.levels[level.number].log_likelihood =
        std::accumulate(likelihood.begin(), likelihood.end(), 0.0) /
        (static_cast<double>(any.map_width) * any.map_height);
    advance();
  }

  void advance() {
    ++steps_done_;
    if (progress_) {
      progress_(steps_done_ / ((options_.passes + 1.0) * static_cast<double>(levels_.size())));
    }
  }

  Device& device_;
  const int lanes_;
  const MixtureOptions options_;
  const std::function<void(double)>& progress_;
  const FittedNormals normals_;
  const std::size_t local_size_;
  std::vector<Level> levels_;
  NormalMixtures result_;
  Kernel fit_texels_, finish_texels_, start_texels_, expect_rows_, add_partials_, maximize_texels_,
      finish_rows_;
  std::map<const ProjectedNormals*, NormalBuffers> normal_buffers_;
  Buffer state_, run_, tally_, likelihood_;
  Buffer partials_, sums_, prior_, status_;  // of a batch with long rows
  int steps_done_ = 0;
};

// Whatever the normals are, lobes share all of them out. Compilers that lose some of a kernel's
// values are seen here: rusticl's of Mesa 25 did, of structs in loops.
void requireWholeTexels(const MipTexels& moments, const std::string& device) {
  constexpr float kSlack = 1e-3f;
  for (std::size_t t = 0; t < moments.texelCount(); ++t) {
    const auto vectors = static_cast<std::size_t>(moments.vectors);
    const std::span<const float4> lobes(&moments.texels[t * vectors], vectors);
    const float whole = std::accumulate(lobes.begin(), lobes.end(), 0.0f,
                                        [](float sum, const float4& lobe) { return sum + lobe.x; });
    if (std::abs(whole - 1) <= kSlack) continue;
    throw Error(
        fmt::format("'{}' fits mixtures wrongly: weights of a texel's lobes add up to {:.3g}, "
                    "not to 1; choose another --device or --on host",
                    device, whole),
        kExitCheckFailed);
  }
}

}  // namespace

NormalMixtures fitMixturesOnDevice(Device& device, ProgramCache& cache, int lanes,
                                   const NormalMap& map, const MixtureOptions& options,
                                   const std::function<void(double)>& progress) {
  checkMixtureOptions(options);
  checkNormalMap(map);
  if (options.order != MixtureOrder::kColours) {
    throw Error(
        fmt::format("the device fits mixtures in the order colours, not {}; fit these on"
                    " the host",
                    mixtureOrderName(options.order)));
  }
  NormalMixtures fitted = DeviceMixtureFit(device, cache, lanes, map, options, progress).run();
  requireWholeTexels(fitted.moments, device.info().name);
  return fitted;
}

}  // namespace glintmark
