#include "host/filter/normal_map.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "host/core/error.h"
#include "host/core/free_memory.h"
#include "host/filter/all_rows.h"

namespace glintmark {
namespace {

// Smallest z of a stored normal: steeper ones are laid here, 89.94 degrees from the surface's
// normal, so that slopes stay finite.
constexpr float kMinZ = 1e-3f;
// Eight bits round a z of 0 to -0.004: that much below the surface still counts as the horizon.
constexpr float kHorizonTolerance = 0.01f;
// Length that normals of checkNormalMap may differ from 1: rounding to single precision.
constexpr float kStoredUnitTolerance = 1e-4f;

using Range = tbb::blocked_range<std::size_t>;
constexpr std::size_t kGrain = 16384;

// The first of [0, count) that `is` holds for; `count` if there is none.
template <class Predicate>
std::size_t firstWhere(std::size_t count, const Predicate& is) {
  return tbb::parallel_reduce(
      Range(0, count, kGrain), count,
      [&](const Range& range, std::size_t first) {
        for (std::size_t i = range.begin(); i < range.end() && i < first; ++i)
          if (is(i)) return i;
        return first;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
}

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
  const std::size_t first =
      firstWhere(values, [&](std::size_t i) { return !std::isfinite(image.pixels[i]); });
  if (first == values) return;
  const std::size_t texel = first / image.channels;
  throw Error(fmt::format("map '{}' has a value that is not finite in texel ({}, {})", name,
                          texel % image.width, texel / image.width));
}

bool isGrey(const Image& image) {
  if (image.channels == 1) return true;
  if (image.channels == 2) return false;
  const std::size_t texels = image.pixels.size() / static_cast<std::size_t>(image.channels);
  return firstWhere(texels, [&](std::size_t i) {
           const float* texel = image.pixels.data() + i * static_cast<std::size_t>(image.channels);
           return texel[0] != texel[1] || texel[0] != texel[2];
         }) == texels;
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

// Texels that speak for a coding.
struct CodingTally {
  std::size_t negative = 0, coded = 0, stored = 0, exact = 0;
  CodingTally& operator+=(const CodingTally& o) {
    negative += o.negative, coded += o.coded, stored += o.stored, exact += o.exact;
    return *this;
  }
};

CodingTally tallyOf(const Image& image) {
  const auto error = [&](const float* texel, const Coding& coding) {
    return std::abs(glm::length(storedNormal(texel, image.channels, coding, 0)) - 1);
  };
  const std::size_t texels = image.pixels.size() / static_cast<std::size_t>(image.channels);
  return tbb::parallel_reduce(
      Range(0, texels, kGrain), CodingTally{},
      [&](const Range& range, CodingTally tally) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const float* texel = image.pixels.data() + i * static_cast<std::size_t>(image.channels);
          const float stored_error = error(texel, kStored);
          tally.negative += texel[0] < kNegative || texel[1] < kNegative;
          tally.coded += error(texel, kCoded) <= static_cast<float>(kUnitTolerance);
          tally.stored += stored_error <= static_cast<float>(kUnitTolerance);
          tally.exact += stored_error <= kExactTolerance;
        }
        return tally;
      },
      [](CodingTally a, const CodingTally& b) { return a += b; });
}

// The coding that makes unit normals of more texels; of two channels, both would.
Coding codingOf(const Image& image) {
  const std::size_t texels = image.pixels.size() / static_cast<std::size_t>(image.channels);
  const auto [negative, coded, stored, exact] = tallyOf(image);
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

// Normals that are not unit, and the first that points into the surface.
struct DecodingTally {
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t outliers = 0, worst = 0, inward = kNone;
  float worst_error = 0, worst_length = 1, inward_z = 0;

  void add(std::size_t i, float length, float z) {
    const float error = std::abs(length - 1);
    if (error > kUnitTolerance) ++outliers;
    if (error > worst_error) worst_error = error, worst_length = length, worst = i;
    if (z < -kHorizonTolerance && inward == kNone) inward = i, inward_z = z;
  }
  // Of texels that come later.
  DecodingTally& operator+=(const DecodingTally& o) {
    outliers += o.outliers;
    if (o.worst_error > worst_error)
      worst_error = o.worst_error, worst_length = o.worst_length, worst = o.worst;
    if (inward == kNone) inward = o.inward, inward_z = o.inward_z;
    return *this;
  }
};

void checkDecoding(const DecodingTally& tally, const NormalMap& map) {
  if (tally.inward != DecodingTally::kNone) {
    throw Error(fmt::format(
        "normal map '{}' points into the surface in texel ({}, {}), where z is "
        "{:.2f}; z must be positive everywhere",
        map.name, tally.inward % map.width_px, tally.inward / map.width_px, tally.inward_z));
  }
  if (static_cast<double>(tally.outliers) <=
      kOutlierShare * static_cast<double>(map.normals.size()))
    return;
  throw Error(fmt::format(
      "'{}' is not a normal map: {} of {} normals are not unit, the worst of length {:.2f} in "
      "texel ({}, {}); store normals of length 1, or say that the image holds heights",
      map.name, tally.outliers, map.normals.size(), tally.worst_length, tally.worst % map.width_px,
      tally.worst / map.width_px));
}

NormalMap decodeNormals(const Image& image, const std::string& name, GreenAxis green) {
  NormalMap map{name, image.width, image.height, {}};
  requireMemory(normalMapBytes(image.width, image.height, false),
                fmt::format("normal map '{}' of {}x{} texels", name, image.width, image.height));
  map.normals.resize(static_cast<std::size_t>(image.width) * image.height);
  const Coding coding = codingOf(image);
  const float green_sign = green == GreenAxis::kUp ? -1.0f : 1.0f;
  const DecodingTally tally = tbb::parallel_reduce(
      Range(0, map.normals.size(), kGrain), DecodingTally{},
      [&](const Range& range, DecodingTally sum) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const float* texel = image.pixels.data() + i * static_cast<std::size_t>(image.channels);
          const glm::vec3 stored = storedNormal(texel, image.channels, coding, image.step);
          const float length = glm::length(stored);
          const glm::vec3 unit = length > 0 ? stored / length : glm::vec3(0, 0, 1);
          sum.add(i, length, unit.z);
          map.normals[i] = liftToHorizon({unit.x, green_sign * unit.y, unit.z});
        }
        return sum;
      },
      [](DecodingTally a, const DecodingTally& b) { return a += b; });
  checkDecoding(tally, map);
  return map;
}

}  // namespace

std::uint64_t normalMapBytes(int width_px, int height_px, bool has_heights) {
  const std::uint64_t texel = sizeof(glm::vec3) + (has_heights ? sizeof(float) : 0);
  return texel * static_cast<std::uint64_t>(width_px) * static_cast<std::uint64_t>(height_px);
}

NormalMap normalsFromHeights(Image heights, double height_scale, const std::string& name) {
  checkImage(heights, name);
  if (!std::isfinite(height_scale)) {
    throw Error(fmt::format("the height scale of map '{}' must be a finite number", name));
  }
  const int width = heights.width, height = heights.height;
  const bool own = heights.channels == 1;  // its pixels are the map's heights, but for their scale
  requireMemory(normalMapBytes(width, height, !own),
                fmt::format("normal map '{}' of {}x{} texels", name, width, height));
  NormalMap map{name, width, height, {}};
  map.normals.resize(static_cast<std::size_t>(width) * height);
  const auto value = [&](int x, int y) { return static_cast<double>(heights.at(x, y)[0]); };
  forAllRows(height, fmt::format("the normals of map {}", name), [&](int y) {
    const int below = (y + height - 1) % height, above = (y + 1) % height;
    glm::vec3* const normals = map.normals.data() + static_cast<std::size_t>(y) * width;
    for (int x = 0; x < width; ++x) {
      const int left = x > 0 ? x - 1 : width - 1, right = x + 1 < width ? x + 1 : 0;
      const double du = 0.5 * width * height_scale * (value(right, y) - value(left, y));
      const double dv = 0.5 * height * height_scale * (value(x, above) - value(x, below));
      normals[x] = liftToHorizon(glm::vec3(glm::normalize(glm::dvec3(-du, -dv, 1))));
    }
  });
  if (own) {
    map.heights = std::move(heights.pixels);
  } else {
    map.heights.resize(map.normals.size());
    for (std::size_t i = 0; i < map.heights.size(); ++i)
      map.heights[i] = heights.pixels[i * static_cast<std::size_t>(heights.channels)];
  }
  if (height_scale != 1)
    for (float& own_height : map.heights)
      own_height = static_cast<float>(height_scale * static_cast<double>(own_height));
  return map;
}

NormalMap decodeNormalMap(Image image, const std::string& name, const NormalMapDecoding& decoding) {
  checkImage(image, name);
  const bool heights = decoding.content == MapContent::kHeights ||
                       (decoding.content == MapContent::kAuto && isGrey(image));
  if (heights) return normalsFromHeights(std::move(image), decoding.height_scale, name);
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
  const std::size_t first = firstWhere(texels, [&](std::size_t i) {
    const glm::vec3& n = map.normals[i];
    // Written so that NaN fails.
    return !(std::abs(glm::length(n) - 1) <= kStoredUnitTolerance) || !(n.z > 0);
  });
  if (first == texels) return;
  throw Error(fmt::format("normal map '{}' has no unit normal that points up in texel ({}, {})",
                          map.name, first % map.width_px, first / map.width_px));
}

}  // namespace glintmark
