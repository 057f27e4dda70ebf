// What one frame's launches share: where effects find the scene, and keep what they upload for it.
#pragma once
#include <any>
#include <functional>
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

  /// The frame's one T, which `make` gives (as a std::shared_ptr<T>) when it is first asked for.
  template <typename T, typename Make>
  T& kept(const Make& make) {
    std::any& place = kept_[typeid(T)];
    if (!place.has_value()) place = std::shared_ptr<T>(make());
    return *std::any_cast<std::shared_ptr<T>&>(place);
  }

 private:
  std::map<std::type_index, std::any> kept_;
};

}  // namespace glintmark
