// Cones cut from an environment map; to the kernels they are lights like others.
#include "host/frame/effect_module.h"

namespace glintmark {
namespace {

void strip(Scene& scene) {
  if (!scene.environment.present) return;
  // The environment's cones stand behind the lights of the scene's own.
  scene.lights.resize(scene.lights.size() - static_cast<std::size_t>(scene.environment.cone_count));
  scene.environment = {};
}

}  // namespace

const EffectModule& environmentEffect() {
  static const EffectModule module = {
      .scene_calls = [](const Scene& scene) { return scene.environment.present; },
      .strip_scene = strip};
  return module;
}

}  // namespace glintmark
