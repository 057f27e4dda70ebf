// Table `effects`: what each effect, each pair and all of them cost, and what not having the others
// saves.
#include <fmt/format.h>

#include <map>
#include <optional>

#include "host/experiment/all_tables.h"
#include "host/experiment/effects/effects_case.h"
#include "host/experiment/effects/effects_table.h"
#include "host/experiment/summary_table.h"
#include "host/parallel/ranks.h"
#include "host/report/picture/image_io.h"

namespace glintmark {
namespace {

constexpr const char* kScene = "mixed";
constexpr const char* kView = "whole";

// A named set of effects.
struct Case {
  std::string name;
  EffectSet set;
};

EffectSet withNeeds(Effect effect) {
  return EffectSet{effect} | effectNeeds(effect);
}

// Nothing, each effect, each pair, and everything that a scene with `called_for` calls for. Effects
// that need others bring them along, so some sets come up twice.
std::vector<Case> casesOf(EffectSet called_for) {
  std::vector<Case> cases;
  const auto add = [&](EffectSet set) {
    for (const Case& known : cases)
      if (known.set == set) return;
    cases.push_back({effectSetName(set), set});
  };
  add({});
  const std::vector<Effect> effects = called_for.list();
  for (const Effect effect : effects) add(withNeeds(effect));
  for (std::size_t i = 0; i < effects.size(); ++i)
    for (std::size_t j = i + 1; j < effects.size(); ++j)
      add(withNeeds(effects[i]) | withNeeds(effects[j]));
  std::erase_if(cases, [&](const Case& known) { return known.set == called_for; });
  cases.push_back({kAllCase, called_for});
  return cases;
}

void measure(BenchRun& run) {
  Scene scene = openScene(run.session().common, kScene);
  const std::vector<Case> cases = casesOf(effectsOf(scene));
  std::vector<std::string> names;
  std::map<std::string, EffectSet> sets;
  for (const Case& known : cases) {
    names.push_back(known.name);
    sets[known.name] = known.set;
  }
  EffectsMeasurer measurer(run, std::move(scene), kView);
  run.measureCases(effectsSpec().name, names, effectsMetrics(),
                   [&](const std::string& name) { return measurer.measure(name, sets.at(name)); });
  if (!allRanks().isFirst()) return;
  writePng(effectsMatrixPicture(run.recordsOf(effectsSpec().name)),
           run.folder() / "effects_matrix.png");
}

std::string text(const BenchRun& run) {
  const RunInfo& info = run.info();
  const std::vector<Record> records = run.recordsOf(effectsSpec().name);
  return fmt::format("Effects of scene {}, view {}, at {}, {} lanes\non {:.90}\n\n", kScene, kView,
                     run.options().size, info.width, info.device) +
         effectsTableText(records) + invalidText(records);
}

}  // namespace

BenchTable effectsBench() {
  return {effectsSpec(), {kScene}, {kView}, measure, text};
}

}  // namespace glintmark
