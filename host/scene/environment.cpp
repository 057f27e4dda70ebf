#include "host/scene/environment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/angles.h"
#include "host/core/error.h"
#include "host/core/float4.h"

namespace glintmark {
namespace {

constexpr int kSkyWidth_px = 512;
constexpr int kSkyHeight_px = 256;
// Each pixel's light is taken to come from its middle, so that it must not be wide.
constexpr int kLeastCutWidth_px = 64, kLeastCutHeight_px = 32;
// Of the largest value: what ringing and fitted codes leave below 0.
constexpr float kTinyShare = 0.01f;

double luminance(const glm::dvec3& rgb) {
  return glm::dot(rgb, {0.2126, 0.7152, 0.0722});
}

/// What cutting needs to know of a set of pixels; sums over more pixels are sums of these.
struct Light {
  glm::dvec3 flux{0};     // rgb: sum of radiance times solid angle
  double luminous = 0;    // luminance of the flux
  glm::dvec3 towards{0};  // sum of luminance times solid angle times direction

  Light& operator+=(const Light& o) {
    flux += o.flux, luminous += o.luminous, towards += o.towards;
    return *this;
  }
  Light operator-(const Light& o) const {
    return {flux - o.flux, luminous - o.luminous, towards - o.towards};
  }
  /// 0 if all the light comes from one direction.
  double spread() const { return luminous - glm::length(towards); }
};

struct Region {
  int x0, x1, y0, y1;  // pixels [x0, x1) x [y0, y1)
  Light light{};
};

struct Cut {
  bool vertical = false;  // between columns, at x; else between rows, at y
  int at = 0;             // first column or row of the second half
  double gain = -1;       // spread removed
};

/// The map, checked, with the directions of its pixels.
class LightMap {
 public:
  LightMap(const Image& map, const EnvironmentCut& cut) : map_(map), scale_(cut.scale) {
    for (int y = 0; y <= map.height; ++y) row_angle_.push_back(kPi * y / map.height);
    for (int x = 0; x < map.width; ++x) {
      const double azimuth = kPi - 2 * kPi * ((x + 0.5) / map.width - 0.5) + cut.rotation_rad;
      column_direction_.emplace_back(std::sin(azimuth), std::cos(azimuth));
    }
  }

  Light pixel(int x, int y) const {
    const double top = row_angle_[y], bottom = row_angle_[y + 1], middle = 0.5 * (top + bottom);
    const double solid_angle = (std::cos(top) - std::cos(bottom)) * 2 * kPi / map_.width;
    const auto rgb = map_.at(x, y);
    Light light;
    light.flux = glm::dvec3(rgb[0], rgb[1], rgb[2]) * (scale_ * solid_angle);
    light.luminous = luminance(light.flux);
    const glm::dvec2 around = column_direction_[x] * std::sin(middle);
    light.towards = light.luminous * glm::dvec3(around.x, std::cos(middle), around.y);
    return light;
  }

 private:
  const Image& map_;
  double scale_;
  std::vector<double> row_angle_;  // from +y to each row's upper border; one more for the last
  std::vector<glm::dvec2> column_direction_;  // x and z
};

/// The best place to cut the lines of a region, given each line's light in order.
void improveCut(const std::vector<Light>& lines, const Light& whole, bool vertical, int first,
                Cut& best) {
  Light before;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    before += lines[i];
    const double gain = whole.spread() - before.spread() - (whole - before).spread();
    if (gain > best.gain) best = {vertical, first + static_cast<int>(i) + 1, gain};
  }
}

/// Fills region.light and finds its best cut; gain stays negative for a single pixel.
Cut examine(const LightMap& map, Region& region) {
  std::vector<Light> columns(region.x1 - region.x0), rows(region.y1 - region.y0);
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      const Light light = map.pixel(x, y);
      columns[x - region.x0] += light;
      rows[y - region.y0] += light;
    }
  }
  region.light = {};
  for (const Light& row : rows) region.light += row;
  Cut best;
  improveCut(columns, region.light, true, region.x0, best);
  improveCut(rows, region.light, false, region.y0, best);
  return best;
}

void checkMap(const Image& map) {
  if (map.width < 1 || map.height < 1 || map.channels < 3) {
    throw Error(fmt::format("the environment map is {} x {} with {} channels, expected rgb pixels",
                            map.width, map.height, map.channels));
  }
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = map.at(x, y)[c];
        if (std::isfinite(value) && value >= 0) continue;
        throw Error(
            fmt::format("pixel ({}, {}) of the environment map is {}, expected a finite "
                        "radiance of at least 0",
                        x, y, value));
      }
    }
  }
}

// The same map in finer pixels, where its own are large parts of the sky.
Image refined(const Image& map) {
  const int across = (kLeastCutWidth_px + map.width - 1) / map.width;
  const int down = (kLeastCutHeight_px + map.height - 1) / map.height;
  Image fine(map.width * across, map.height * down, map.channels);
  for (int y = 0; y < fine.height; ++y)
    for (int x = 0; x < fine.width; ++x)
      std::ranges::copy(map.at(x / across, y / down), fine.at(x, y).begin());
  return fine;
}

ConeLight toCone(const Light& light) {
  const double length = glm::length(light.towards);
  const glm::dvec3 axis = length > 0 ? light.towards / length : glm::dvec3(0, 1, 0);
  // The mean direction of an even cone of half-angle a has length (1 + cos a) / 2.
  const double mean_length = light.luminous > 0 ? std::min(length / light.luminous, 1.0) : 0.5;
  const double cos_angle = std::clamp(2 * mean_length - 1, 0.0, 1.0);
  const glm::dvec3 irradiance = light.flux * (0.5 * (1 + cos_angle));
  ConeLight cone;
  cone.direction = toFloat4(axis, std::acos(cos_angle));
  cone.irradiance = toFloat4(irradiance);
  return cone;
}

}  // namespace

std::string clampTinyNegatives(Image& map) {
  float largest = 0, least = 0;
  for (const float value : map.pixels)
    if (std::isfinite(value)) largest = std::max(largest, value);
  std::size_t count = 0;
  for (float& value : map.pixels) {
    if (!(value < 0) || !(value >= -kTinyShare * largest)) continue;
    ++count;
    least = std::min(least, value);
    value = 0;
  }
  if (count == 0) return "";
  return fmt::format("{} values of the environment map below 0, at least {}, count as 0", count,
                     least);
}

std::vector<ConeLight> cutEnvironment(const Image& given, const EnvironmentCut& cut) {
  checkMap(given);
  const bool is_coarse = given.width < kLeastCutWidth_px || given.height < kLeastCutHeight_px;
  const Image fine = is_coarse ? refined(given) : Image();
  const Image& map = is_coarse ? fine : given;
  const LightMap light_map(map, cut);
  std::vector<Region> regions = {{0, map.width, 0, map.height}};
  std::vector<Cut> cuts = {examine(light_map, regions[0])};
  if (regions[0].light.luminous <= 0) {
    throw Error("the environment map is black, expected some light or no environment at all");
  }
  while (static_cast<int>(regions.size()) < cut.cone_count) {
    const auto best = std::max_element(cuts.begin(), cuts.end(),
                                       [](const Cut& a, const Cut& b) { return a.gain < b.gain; });
    if (best->gain <= 0) break;
    const std::size_t index = static_cast<std::size_t>(best - cuts.begin());
    Region second = regions[index];
    (best->vertical ? second.x0 : second.y0) = best->at;
    (best->vertical ? regions[index].x1 : regions[index].y1) = best->at;
    cuts[index] = examine(light_map, regions[index]);
    cuts.push_back(examine(light_map, second));
    regions.push_back(second);
  }
  std::vector<ConeLight> cones;
  for (const Region& region : regions) {
    if (region.light.luminous > 0) cones.push_back(toCone(region.light));
  }
  return cones;
}

glm::dvec3 coneFlux(const ConeLight& light) {
  return glm::dvec3(light.irradiance.x, light.irradiance.y, light.irradiance.z) *
         (2 / (1 + std::cos(static_cast<double>(light.direction.w))));
}

glm::dvec3 environmentRadiance(const Image& map, const EnvironmentCut& cut,
                               const glm::dvec3& direction) {
  const glm::dvec3 towards = glm::normalize(direction);
  const double azimuth = std::atan2(towards.x, towards.z) - cut.rotation_rad;
  const double from_zenith = std::acos(std::clamp(towards.y, -1.0, 1.0));
  const double x = (0.5 + (kPi - azimuth) / (2 * kPi)) * map.width - 0.5;
  const double y = std::clamp(from_zenith / kPi * map.height - 0.5, 0.0, map.height - 1.0);
  const double left = std::floor(x), top = std::min(std::floor(y), map.height - 2.0);
  const auto pixel = [&](double column, double row) {
    const double around = column - std::floor(column / map.width) * map.width;
    const auto rgb = map.at(static_cast<int>(around), static_cast<int>(std::max(row, 0.0)));
    return glm::dvec3(rgb[0], rgb[1], rgb[2]);
  };
  const auto row = [&](double at) {
    return glm::mix(pixel(left, at), pixel(left + 1, at), x - left);
  };
  return cut.scale * glm::mix(row(top), row(top + 1), std::clamp(y - top, 0.0, 1.0));
}

Image renderSky(const SkyParameters& sky) {
  Image map(kSkyWidth_px, kSkyHeight_px, 3);
  for (int y = 0; y < map.height; ++y) {
    const double from_zenith = kPi * (y + 0.5) / map.height;
    const double height = std::cos(from_zenith);
    // The horizon's colour fills most of the lower sky; the ground is even.
    const glm::dvec3 background =
        height > 0 ? glm::mix(sky.horizon, sky.zenith, std::sqrt(height)) : sky.ground;
    for (int x = 0; x < map.width; ++x) {
      const double azimuth = kPi - 2 * kPi * ((x + 0.5) / map.width - 0.5);
      const glm::dvec3 direction(std::sin(from_zenith) * std::sin(azimuth), height,
                                 std::sin(from_zenith) * std::cos(azimuth));
      glm::dvec3 radiance = background;
      for (const SkyParameters::Lamp& lamp : sky.lamps) {
        if (glm::dot(direction, lamp.direction) > std::cos(lamp.half_angle_rad)) {
          radiance += lamp.radiance;
        }
      }
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = static_cast<float>(radiance[c]);
    }
  }
  return map;
}

}  // namespace glintmark
