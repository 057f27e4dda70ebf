#include "host/frame/effect_set.h"

#include "host/frame/effect_module.h"

namespace glintmark {

const EffectModule& effectModule(Effect effect) {
  return *effectModules()[static_cast<std::size_t>(effect)];
}

std::span<const EffectModule* const> effectModules() {
  static const EffectModule* const modules[kEffectCount] = {
#define EFFECT(enumerator, module) &module(),
#include "host/frame/effect/all_effects.inc"
  };
  return modules;
}

std::vector<Effect> EffectSet::list() const {
  std::vector<Effect> effects;
  for (unsigned i = 0; i < kEffectCount; ++i)
    if (has(static_cast<Effect>(i))) effects.push_back(static_cast<Effect>(i));
  return effects;
}

EffectSet EffectSet::all() {
  return EffectSet((1u << kEffectCount) - 1u);
}

std::string_view effectName(Effect effect) {
  return effectModule(effect).name;
}

std::string effectSetName(EffectSet set) {
  std::string name;
  for (const Effect effect : set.list()) {
    if (!name.empty()) name += "+";
    name += effectName(effect);
  }
  return name.empty() ? "none" : name;
}

EffectSet effectNeeds(Effect effect) {
  return effectModule(effect).needs;
}

EffectSet effectsOf(const Scene& scene) {
  EffectSet set;
  for (const Effect effect : EffectSet::all().list())
    if (effectModule(effect).called_for(scene)) set = set | EffectSet{effect};
  return set;
}

EffectSet effectsOf(const KernelConfig& config) {
  EffectSet set;
  for (const Effect effect : EffectSet::all().list()) {
    const EffectModule& module = effectModule(effect);
    if (module.is_in && module.is_in(config)) set = set | EffectSet{effect};
  }
  return set;
}

Scene withEffects(Scene scene, EffectSet kept) {
  for (const Effect effect : EffectSet::all().without(kept).list())
    if (effectModule(effect).strip) effectModule(effect).strip(scene);
  return scene;
}

ShadingOptions withEffects(ShadingOptions options, EffectSet kept) {
  for (const Effect effect : EffectSet::all().without(kept).list())
    if (effectModule(effect).strip_options) effectModule(effect).strip_options(options);
  return options;
}

}  // namespace glintmark
