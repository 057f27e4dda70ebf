// Knobs of polygon area lights, and Monte Carlo as their rival. [TAO21], [HDHN16]
#include <fmt/format.h>

#include "host/core/disk_cache.h"
#include "host/core/error.h"
#include "host/experiment/accuracy/accuracy_table.h"
#include "host/experiment/accuracy/accuracy_truth.h"
#include "host/experiment/accuracy/knob_settings.h"
#include "host/fit/ltc_fit.h"

namespace glintmark {
namespace {

constexpr int kTableSizes[] = {8, 16, 32, LTC_SIZE_DEFAULT, 128};
constexpr int kMonteCarloSamples[] = {1, 4, 16, 64, 256, 1024};
constexpr SampledTruthSettings kLtcTruth = {PrincipalMetric::kRelMse, 320, 4096};

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

std::vector<AccuracySetting> ltcSettings(int threads) {
  KnobSettings knobs("ltc");
  std::vector<AccuracySetting> all;
  knobs.moveTo(all, {"method"});
  for (const int size : kTableSizes)
    all.push_back(
        {fmt::format("table={}", size),
         [size, threads, table = std::shared_ptr<const LtcTable>()](ShadingOptions& o) mutable {
           if (!table) table = fittedTable(size, threads);
           o.ltc_table = table;
         },
         size == LTC_SIZE_DEFAULT ? kAccuracyDefault : kAccuracyKnob});
  knobs.moveTo(all, {"table_texels", "edges", "horizon"});
  knobs.moveRestTo(all);
  for (const int samples : kMonteCarloSamples)
    all.push_back({fmt::format("mc_samples={}", samples), {}, kAccuracySampled, samples});
  return all;
}

}  // namespace

AccuracyKind ltcAccuracy() {
  return {"ltc",
          knobsOf(ltcSettings(1)),
          {"area_cloth/near", "area_cloth/middle", "area_cloth/far", "area_knot/near",
           "area_knot/middle", "area_knot/far", "area_glass/near", "area_glass/middle",
           "area_glass/far", "area_shapes/near", "area_shapes/middle", "area_shapes/far",
           "area_plane/front", "area_brushed/front", "area_brushed/grazing"},
          {"area_cloth/near", "area_cloth/middle", "area_cloth/far", "area_knot/middle",
           "area_glass/middle"},
          [](BenchRun& run, const std::vector<std::string>& scenes) {
            return std::unique_ptr<AccuracyEffect>(std::make_unique<SampledSweep>(
                run, "ltc", scenes, ltcSettings(run.threads()), kLtcTruth));
          }};
}

}  // namespace glintmark
