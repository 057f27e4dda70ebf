#include "host/frame/background.h"

#include "host/raster/camera.h"
#include "host/scene/environment.h"

namespace glintmark {

void placeBackground(Image& picture, const Scene& scene, const View& view) {
  const EnvironmentInfo& environment = scene.environment;
  if (environment.map == nullptr) return;
  const Camera camera = makeCamera(view, picture.width, picture.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const auto pixel = picture.at(x, y);
      const double room = 1 - double{pixel[3]};
      if (room <= 0) continue;
      const glm::dvec3 radiance =
          environmentRadiance(*environment.map, environment.cut, camera.ray(x, y));
      for (int c = 0; c < 3; ++c) pixel[c] += static_cast<float>(room * radiance[c]);
      pixel[3] = 1;
    }
}

}  // namespace glintmark
