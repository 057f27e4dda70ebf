#include "host/experiment/mixture_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/report/picture/picture_strip.h"

namespace glintmark {
namespace {

// Display colour of a unit normal, as normal maps are stored and seen.
glm::vec3 normalColour(glm::vec2 mean) {
  const float z = std::sqrt(std::max(0.0f, 1 - glm::dot(mean, mean)));
  return 0.5f * glm::vec3(mean.x, -mean.y, z) + 0.5f;
}

}  // namespace

Image mixturePicture(const NormalMixtures& mixtures, int level, int texel_px,
                     const std::string& label) {
  const int width = mixtures.moments.levelWidth(level);
  const int height = mixtures.moments.levelHeight(level);
  std::vector<std::pair<std::string, Image>> lobes;
  for (int i = 0; i < mixtures.lobes; ++i) {
    Image image(width * texel_px, height * texel_px, 3);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const float4* texel = mixtures.moments.at(level, x / texel_px, y / texel_px);
        float heaviest = 0;
        for (int k = 0; k < mixtures.lobes; ++k) heaviest = std::max(heaviest, texel[k].x);
        const NormalLobe lobe = lobeFromMoments(texel[i]);
        const glm::vec3 colour = normalColour(lobe.mean) * (lobe.weight / heaviest);
        for (int c = 0; c < 3; ++c) image.at(x, y)[c] = colour[c];
      }
    }
    lobes.emplace_back(fmt::format("{} {}", label, i + 1), std::move(image));
  }
  return pictureStrip(lobes);
}

int pictureLevel(const NormalMixtures& mixtures, int width_px) {
  int level = 0;
  while (mixtures.moments.levelWidth(level) * mixtures.lobes > width_px) ++level;
  return level;
}

}  // namespace glintmark
