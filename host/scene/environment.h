// Environment maps as a few cone lights. [ZK16] Fig. 10c lights glitter by an environment map; its
// glint model knows cones of light (Sect. 4.3), so the map is cut into regions, one cone each.
//
// Maps are latitude-longitude: the top row looks along +y, the middle of the image along -z, and
// +x lies to the right of it. Pixels are radiance, linear rgb.
#pragma once
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/core/shared_types.h"

namespace glintmark {

struct EnvironmentCut {
  int cone_count = 8;
  double scale = 1;         // radiance of the lights per radiance of the map
  double rotation_rad = 0;  // of the map around y, +z towards +x
};

/// Cuts a map into at most `cone_count` rectangles of pixels and returns one cone for each that is
/// not black: its flux (radiance times solid angle, rgb) is the region's, its direction the mean
/// direction of the region's luminance, and its half-angle that of the even cone whose mean
/// direction is as long as the region's, at most 90 degrees. Regions are cut one at a time where a
/// cut removes the most spread, so the result depends on nothing but the map. Throws Error for a
/// map without pixels or with fewer than three channels, for a value that is negative or not
/// finite, and for a black map.
std::vector<ConeLight> cutEnvironment(const Image& map, const EnvironmentCut& cut);

/// Radiance (rgb) that a map as cut brings from a direction (not 0, any length), linear between the
/// centres of pixels.
glm::dvec3 environmentRadiance(const Image& map, const EnvironmentCut& cut,
                               const glm::dvec3& direction);

/// Sets values below 0 to 0 that are small beside the map's largest, as filters and fits leave
/// them, and returns a sentence about them; empty if there are none.
std::string clampTinyNegatives(Image& map);

/// The flux (rgb) that an even cone of this irradiance brings: irradiance * 2 / (1 + cos(angle)).
glm::dvec3 coneFlux(const ConeLight& light);

/// A procedural sky: colours blended by elevation, and round lamps.
struct SkyParameters {
  struct Lamp {
    glm::dvec3 direction{0, 1, 0};  // unit
    double half_angle_rad = 0.1;
    glm::dvec3 radiance{10};
  };
  glm::dvec3 zenith{0.12, 0.25, 0.6};
  glm::dvec3 horizon{0.7, 0.75, 0.8};
  glm::dvec3 ground{0.1, 0.09, 0.08};
  std::vector<Lamp> lamps;
};

/// The sky as a map of 512 x 256 pixels.
Image renderSky(const SkyParameters& sky);

}  // namespace glintmark
