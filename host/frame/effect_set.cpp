#include "host/frame/effect_set.h"

#include <algorithm>

#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

// What the table of switches says of an effect; without a switch of its own it has no functions.
struct Row {
  std::string_view name;
  const EffectModule& (*module)();
  bool (*is_on)(const KernelConfig& config) = nullptr;
  void (*turn_on)(KernelConfig& config) = nullptr;
};

constexpr Row kRows[kEffectCount] = {
#define MODULE(enumerator, name) {#name, name##Effect},
#define EFFECT(enumerator, name, macro, type, member, ...)                        \
  {#name, name##Effect, [](const KernelConfig& c) { return c.member != type{}; }, \
   [](KernelConfig& c) { c.member = static_cast<type>(1); }},
#include "host/ocl/switches.inc"
};

const Row& rowOf(Effect effect) {
  return kRows[static_cast<std::size_t>(effect)];
}

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
  return rowOf(effect).module();
}

std::span<const EffectModule* const> effectModules() {
  static const EffectModule* const modules[kEffectCount] = {
#define MODULE(enumerator, name) &name##Effect(),
#include "host/ocl/switches.inc"
  };
  return modules;
}

void turnOn(Effect effect, KernelConfig& config) {
  if (const Row& row = rowOf(effect); row.turn_on) row.turn_on(config);
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
  return rowOf(effect).name;
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
    const auto is_in = rowOf(effect).is_on ? rowOf(effect).is_on : effectModule(effect).is_in;
    if (is_in && is_in(config)) set = set | EffectSet{effect};
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
