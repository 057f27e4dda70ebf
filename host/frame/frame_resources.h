// What one frame's launches share: where effects find the scene, and keep what they upload for it.
#pragma once
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <typeindex>
#include <typeinfo>

#include "host/frame/effect/normal_maps.h"
#include "host/frame/shading_options.h"
#include "host/ocl/device.h"
#include "host/scene/scene.h"

namespace glintmark {

class FrameResources {
 public:
  /// All must outlive this. Positions on the device are relative to `eye`.
  FrameResources(Device& device_, const Scene& scene_, const ShadingOptions& options_,
                 NormalTextures& textures_, const glm::dvec3& eye_)
      : device(device_), scene(scene_), options(options_), textures(textures_), eye(eye_) {}

  Device& device;
  const Scene& scene;
  const ShadingOptions& options;
  NormalTextures& textures;
  const glm::dvec3 eye;

  /// The frame's one T, which `make` returns when it is first asked for.
  template <typename T, typename Make>
  T& kept(const Make& make) {
    std::shared_ptr<void>& place = kept_[typeid(T)];
    if (!place) place = std::make_shared<T>(make());
    return *static_cast<T*>(place.get());
  }

 private:
  std::map<std::type_index, std::shared_ptr<void>> kept_;  // each of the type that it stands under
};

}  // namespace glintmark
