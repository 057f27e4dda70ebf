// Knobs of polygon area lights, and Monte Carlo as their rival. [TAO21], [HDHN16]
#include <fmt/format.h>

#include "host/core/disk_cache.h"
#include "host/core/error.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/accuracy/accuracy_truth.h"
#include "host/experiment/tao21/tao21_table.h"
#include "host/fit/ltc_fit.h"

namespace glintmark {
namespace {

constexpr int kTableSizes[] = {8, 16, 32, LTC_SIZE_DEFAULT, 128};
constexpr int kMonteCarloSamples[] = {1, 4, 16, 64, 256, 1024};
constexpr const char* kEdges[] = {"polynomial", "acos", "rational"};  // enum EdgeIntegral
constexpr SampledTruthSettings kTruth = {PrincipalMetric::kRelMse, 320, 4096};

// A fitted table of GGX, from the disk cache if it is there: a table of 128 takes most of a minute.
std::shared_ptr<const LtcTable> fittedTable(int size, int threads) {
  const DiskCache cache = DiskCache::fromEnvironment();
  const std::string name = fmt::format("ltc_ggx_{}", size);
  const std::string key = fmt::format("ltc table, GGX, size {}, fit 1", size);
  if (const auto bytes = cache.load(name, key)) {
    try {
      return std::make_shared<const LtcTable>(parseLtcTable(*bytes, name));
    } catch (const Error&) {
      // Of another layout: fitted anew.
    }
  }
  auto table = std::make_shared<const LtcTable>(fitLtcTable(
      {.size = size, .threads = threads, .progress = [](double) { stopIfInterrupted(); }}));
  cache.store(name, key, serializeLtcTable(*table));
  return table;
}

std::vector<AccuracySetting> settings(int threads) {
  std::vector<AccuracySetting> all;
  const auto add = [&](const std::string& name, bool is_default,
                       std::function<void(ShadingOptions&)> apply) {
    all.push_back({name, std::move(apply), is_default ? kAccuracyDefault : kAccuracyKnob});
  };
  for (const LtcMethod method : {LtcMethod::kExact, LtcMethod::kTao21, LtcMethod::kOriginal})
    add(fmt::format("method={}", kTao21Methods[static_cast<std::size_t>(method)]),
        method == LtcMethod::kExact, [method](ShadingOptions& o) { o.ltc_method = method; });
  for (const int size : kTableSizes)
    add(fmt::format("table={}", size), size == LTC_SIZE_DEFAULT,
        [size, threads, table = std::shared_ptr<const LtcTable>()](ShadingOptions& o) mutable {
          if (!table) table = fittedTable(size, threads);
          o.ltc_table = table;
        });
  for (const bool half : {false, true})
    add(half ? "table_texels=half" : "table_texels=float", !half,
        [half](ShadingOptions& o) { o.ltc_half = half; });
  for (int edges = 0; edges < 3; ++edges)
    add(fmt::format("edges={}", kEdges[edges]), edges == 0,
        [edges](ShadingOptions& o) { o.edges = static_cast<EdgeIntegral>(edges); });
  for (const bool clipless : {false, true})
    add(clipless ? "horizon=clipless" : "horizon=clipped", !clipless,
        [clipless](ShadingOptions& o) { o.clipless = clipless; });
  for (const int samples : kMonteCarloSamples)
    all.push_back({fmt::format("mc_samples={}", samples), {}, kAccuracyRival, samples});
  return all;
}

}  // namespace

AccuracyKind ltcAccuracy() {
  return {"ltc",
          knobsOf(settings(1)),
          {"area_plane/front", "area_knot/near", "area_knot/middle", "area_knot/far",
           "area_cloth/near", "area_cloth/middle", "area_cloth/far", "area_glass/near",
           "area_glass/middle", "area_glass/far"},
          {"area_plane/front", "area_knot/middle"},
          [](BenchRun& run, const std::vector<std::string>& scenes) {
            return std::unique_ptr<AccuracyEffect>(std::make_unique<SampledSweep>(
                run, "ltc", scenes, settings(run.threads()), kTruth));
          }};
}

}  // namespace glintmark
