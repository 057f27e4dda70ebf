#include "host/frame/effect_set.h"

#include <algorithm>

#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

bool isCalledFor(const EffectModule& module, const Scene& scene) {
  if (!module.scene_calls && !module.material_calls)
    return std::ranges::all_of(module.needs.list(), [&](Effect needed) {
      return isCalledFor(effectModule(needed), scene);
    });
  return (module.scene_calls && module.scene_calls(scene)) ||
         (module.material_calls && std::ranges::any_of(scene.materials, module.material_calls));
}

}  // namespace

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
    if (isCalledFor(effectModule(effect), scene)) set = set | EffectSet{effect};
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
  for (const Effect effect : EffectSet::all().without(kept).list()) {
    const EffectModule& module = effectModule(effect);
    if (module.strip_scene) module.strip_scene(scene);
    if (module.strip_material) std::ranges::for_each(scene.materials, module.strip_material);
  }
  return scene;
}

ShadingOptions withEffects(ShadingOptions options, EffectSet kept) {
  for (const Effect effect : EffectSet::all().without(kept).list())
    if (effectModule(effect).strip_options) effectModule(effect).strip_options(options);
  return options;
}

}  // namespace glintmark
