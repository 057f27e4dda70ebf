#include "host/frame/effect_set.h"

#include <algorithm>
#include <array>

namespace glintmark {
namespace {

constexpr std::array<std::string_view, kEffectCount> kNames = {
    "glints",     "grooves",      "colour",       "normals",    "ltc",
    "multiscale", "multiscatter", "compensation", "environment"};

EffectSet effectsOf(const Material& material) {
  EffectSet set;
  if (material.has_glints)
    set = set | EffectSet{material.has_grooves ? Effect::kGrooves : Effect::kGlints};
  if (material.has_glints && !material.has_grooves && material.has_colour)
    set = set | EffectSet{Effect::kColour};
  if (material.normal_map) set = set | EffectSet{Effect::kNormals};
  if (material.diffuse_model != DiffuseModel::kLambert)
    set = set | EffectSet{Effect::kMultiscatter};
  if (material.compensation != Compensation::kOff) set = set | EffectSet{Effect::kCompensation};
  return set;
}

void strip(Material& material, EffectSet kept) {
  const bool stays = kept.has(material.has_grooves ? Effect::kGrooves : Effect::kGlints);
  if (!stays) material.has_glints = material.has_grooves = false;
  if (!kept.has(Effect::kColour)) material.has_colour = false;
  if (!kept.has(Effect::kNormals)) material.normal_map.reset();
  if (!kept.has(Effect::kMultiscatter)) material.diffuse_model = DiffuseModel::kLambert;
  if (!kept.has(Effect::kCompensation)) material.compensation = Compensation::kOff;
}

}  // namespace

std::vector<Effect> EffectSet::list() const {
  std::vector<Effect> effects;
  for (unsigned i = 0; i < kEffectCount; ++i)
    if (has(static_cast<Effect>(i))) effects.push_back(static_cast<Effect>(i));
  return effects;
}

std::string_view effectName(Effect effect) {
  return kNames.at(static_cast<std::size_t>(effect));
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
  if (effect == Effect::kColour) return {Effect::kGlints};
  if (effect == Effect::kMultiscale) return {Effect::kNormals, Effect::kLtc};
  return {};
}

EffectSet effectsOf(const Scene& scene) {
  EffectSet set;
  for (const Material& material : scene.materials) set = set | effectsOf(material);
  if (!scene.area_lights.empty()) set = set | EffectSet{Effect::kLtc};
  if (set.holds(effectNeeds(Effect::kMultiscale))) set = set | EffectSet{Effect::kMultiscale};
  if (scene.environment.present) set = set | EffectSet{Effect::kEnvironment};
  return set;
}

Scene withEffects(Scene scene, EffectSet kept) {
  for (Material& material : scene.materials) strip(material, kept);
  if (!kept.has(Effect::kLtc)) scene.area_lights.clear();
  if (!kept.has(Effect::kEnvironment) && scene.environment.present) {
    // The environment's cones stand behind the lights of the scene's own.
    scene.lights.resize(scene.lights.size() -
                        static_cast<std::size_t>(scene.environment.cone_count));
    scene.environment = {};
  }
  return scene;
}

ShadingOptions withEffects(ShadingOptions options, EffectSet kept) {
  if (!kept.has(Effect::kMultiscale)) options.ltc_method = LtcMethod::kOriginal;
  return options;
}

}  // namespace glintmark
