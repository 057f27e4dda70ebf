#include "host/filter/normal_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "host/core/error.h"

namespace glintmark {
namespace {

// Smallest z of a stored normal: steeper ones are laid here, 89.94 degrees from the surface's
// normal, so that slopes stay finite.
constexpr float kMinZ = 1e-3f;
// Eight bits round a z of 0 to -0.004: that much below the surface still counts as the horizon.
constexpr float kHorizonTolerance = 0.01f;
// Length that normals of checkNormalMap may differ from 1: rounding to single precision.
constexpr float kStoredUnitTolerance = 1e-4f;

void checkSize(int width, int height, const std::string& name) {
  if (width < 1 || height < 1 || width > kMaxNormalMapSize_px || height > kMaxNormalMapSize_px) {
    throw Error(fmt::format("map '{}' has {}x{} texels; it needs 1 to {} in each direction", name,
                            width, height, kMaxNormalMapSize_px));
  }
}

void checkImage(const Image& image, const std::string& name) {
  checkSize(image.width, image.height, name);
  const std::size_t values = static_cast<std::size_t>(image.width) * image.height * image.channels;
  if (image.channels < 1 || image.pixels.size() != values) {
    throw Error(fmt::format("map '{}' holds {} values; {}x{} texels of {} channels need {}", name,
                            image.pixels.size(), image.width, image.height, image.channels,
                            values));
  }
  for (std::size_t i = 0; i < values; ++i) {
    if (!std::isfinite(image.pixels[i])) {
      const std::size_t texel = i / image.channels;
      throw Error(fmt::format("map '{}' has a value that is not finite in texel ({}, {})", name,
                              texel % image.width, texel / image.width));
    }
  }
}

bool isGrey(const Image& image) {
  if (image.channels == 1) return true;
  if (image.channels == 2) return false;
  for (std::size_t i = 0; i < image.pixels.size(); i += image.channels) {
    if (image.pixels[i] != image.pixels[i + 1] || image.pixels[i] != image.pixels[i + 2]) {
      return false;
    }
  }
  return true;
}

// How the numbers of an image stand for components of normals: n = value * scale + offset.
struct Coding {
  float scale = 2, offset = -1;
};

constexpr Coding kCoded{2, -1}, kStored{1, 0};
// Below 0 by more than what resampling leaves beside an edge.
constexpr float kNegative = -0.01f;
constexpr double kNegativeShare = 1e-3;
constexpr float kExactTolerance = 0.01f;  // half floats

// The stored normal of one texel, not yet unit, y still as the file has it.
glm::vec3 storedNormal(const float* texel, int channels, const Coding& coding, float step) {
  float x = texel[0] * coding.scale + coding.offset, y = texel[1] * coding.scale + coding.offset;
  // Whole numbers have none in the middle: those beside it both mean flat.
  if (std::abs(x) < 1.5f * step && std::abs(y) < 1.5f * step) x = y = 0;
  if (channels == 2) return {x, y, std::sqrt(std::max(0.0f, 1 - x * x - y * y))};
  return {x, y, texel[2] * coding.scale + coding.offset};
}

// The coding that makes unit normals of more texels; of two channels, both would.
Coding codingOf(const Image& image) {
  std::size_t negative = 0, coded = 0, stored = 0, exact = 0;
  const std::size_t texels = image.pixels.size() / static_cast<std::size_t>(image.channels);
  const auto error = [&](const float* texel, const Coding& coding) {
    return std::abs(glm::length(storedNormal(texel, image.channels, coding, 0)) - 1);
  };
  for (std::size_t i = 0; i < texels; ++i) {
    const float* texel = image.pixels.data() + i * static_cast<std::size_t>(image.channels);
    negative += texel[0] < kNegative || texel[1] < kNegative;
    const float stored_error = error(texel, kStored);
    coded += error(texel, kCoded) <= static_cast<float>(kUnitTolerance);
    stored += stored_error <= static_cast<float>(kUnitTolerance);
    exact += stored_error <= kExactTolerance;
  }
  const bool has_negative =
      static_cast<double>(negative) > kNegativeShare * static_cast<double>(texels);
  if (image.channels == 2 || coded == stored) return has_negative ? kStored : kCoded;
  // Without a negative number a photograph may look like normals; only floats that are unit are.
  const bool is_exact = image.step == 0 && exact == texels;
  return stored > coded && (has_negative || is_exact) ? kStored : kCoded;
}

glm::vec3 liftToHorizon(const glm::vec3& unit) {
  if (unit.z >= kMinZ) return unit;
  return glm::normalize(glm::vec3(unit.x, unit.y, kMinZ));
}

NormalMap decodeNormals(const Image& image, const std::string& name, GreenAxis green) {
  NormalMap map{name, image.width, image.height, {}};
  map.normals.resize(static_cast<std::size_t>(image.width) * image.height);
  const Coding coding = codingOf(image);
  const float green_sign = green == GreenAxis::kUp ? -1.0f : 1.0f;
  std::size_t outliers = 0, worst = 0;
  float worst_error = 0, worst_length = 1;
  for (std::size_t i = 0; i < map.normals.size(); ++i) {
    const glm::vec3 stored =
        storedNormal(image.pixels.data() + i * image.channels, image.channels, coding, image.step);
    const float length = glm::length(stored), error = std::abs(length - 1);
    if (error > kUnitTolerance) ++outliers;
    if (error > worst_error) worst_error = error, worst_length = length, worst = i;
    const glm::vec3 unit = length > 0 ? stored / length : glm::vec3(0, 0, 1);
    if (unit.z < -kHorizonTolerance) {
      throw Error(
          fmt::format("normal map '{}' points into the surface in texel ({}, {}), where z is "
                      "{:.2f}; z must be positive everywhere",
                      name, i % image.width, i / image.width, unit.z));
    }
    map.normals[i] = liftToHorizon({unit.x, green_sign * unit.y, unit.z});
  }
  if (static_cast<double>(outliers) > kOutlierShare * static_cast<double>(map.normals.size())) {
    throw Error(fmt::format(
        "'{}' is not a normal map: {} of {} normals are not unit, the worst of length {:.2f} in "
        "texel ({}, {}); store normals of length 1, or say that the image holds heights",
        name, outliers, map.normals.size(), worst_length, worst % image.width,
        worst / image.width));
  }
  return map;
}

}  // namespace

NormalMap normalsFromHeights(const Image& heights, double height_scale, const std::string& name) {
  checkImage(heights, name);
  if (!std::isfinite(height_scale)) {
    throw Error(fmt::format("the height scale of map '{}' must be a finite number", name));
  }
  const int width = heights.width, height = heights.height;
  NormalMap map{name, width, height, {}};
  map.normals.reserve(static_cast<std::size_t>(width) * height);
  map.heights.reserve(static_cast<std::size_t>(width) * height);
  const auto value = [&](int x, int y) { return static_cast<double>(heights.at(x, y)[0]); };
  for (int y = 0; y < height; ++y) {
    const int below = (y + height - 1) % height, above = (y + 1) % height;
    for (int x = 0; x < width; ++x) {
      const int left = (x + width - 1) % width, right = (x + 1) % width;
      const double du = 0.5 * width * height_scale * (value(right, y) - value(left, y));
      const double dv = 0.5 * height * height_scale * (value(x, above) - value(x, below));
      map.normals.push_back(liftToHorizon(glm::vec3(glm::normalize(glm::dvec3(-du, -dv, 1)))));
      map.heights.push_back(static_cast<float>(height_scale * value(x, y)));
    }
  }
  return map;
}

NormalMap decodeNormalMap(const Image& image, const std::string& name,
                          const NormalMapDecoding& decoding) {
  checkImage(image, name);
  const bool heights = decoding.content == MapContent::kHeights ||
                       (decoding.content == MapContent::kAuto && isGrey(image));
  if (heights) return normalsFromHeights(image, decoding.height_scale, name);
  if (image.channels < 2) {
    throw Error(
        fmt::format("'{}' has one channel, which can only be heights; normals need two or "
                    "three",
                    name));
  }
  return decodeNormals(image, name, decoding.green);
}

NormalMap readNormalMap(const std::filesystem::path& file,
                        const std::function<Image(const std::filesystem::path&)>& image_loader,
                        const NormalMapDecoding& decoding) {
  return decodeNormalMap(image_loader(file), file.filename().string(), decoding);
}

void checkNormalMap(const NormalMap& map) {
  checkSize(map.width_px, map.height_px, map.name);
  const std::size_t texels = static_cast<std::size_t>(map.width_px) * map.height_px;
  if (map.normals.size() != texels) {
    throw Error(fmt::format("normal map '{}' holds {} normals; {}x{} texels need {}", map.name,
                            map.normals.size(), map.width_px, map.height_px, texels));
  }
  for (std::size_t i = 0; i < texels; ++i) {
    const glm::vec3& n = map.normals[i];
    // Written so that NaN fails.
    if (!(std::abs(glm::length(n) - 1) <= kStoredUnitTolerance) || !(n.z > 0)) {
      throw Error(fmt::format("normal map '{}' has no unit normal that points up in texel ({}, {})",
                              map.name, i % map.width_px, i / map.width_px));
    }
  }
}

}  // namespace glintmark
