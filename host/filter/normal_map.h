// Normal maps: what every filtering method of this folder starts from.
//
// Tangent space: x along u, y along v, z out of the surface. Row 0 lies at v = 0 and rows follow
// growing v; texel (x, y) is a sample at uv ((x + 0.5) / width, (y + 0.5) / height). A map repeats
// with period 1 in u and in v, and u and v span the same length on the surface.
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "host/core/image.h"
#include "host/core/large_array.h"

namespace glintmark {

/// Texels per side that a map may have.
inline constexpr int kMaxNormalMapSize_px = 16384;
/// Gaussians that may stand for the normals of a texel: LOBES of kernels/normals/normal_config.clh.
inline constexpr int kMaxLobes = 8;

/// Unit normals with z > 0, row by row.
struct NormalMap {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  LargeArray<glm::vec3> normals;
  /// What the normals are of, in units of the map's side; empty of a map that was read as normals.
  std::vector<float> heights{};

  const glm::vec3& at(int x, int y) const {
    return normals[static_cast<std::size_t>(y) * width_px + x];
  }
};

/// Bytes of a map of so many texels, with or without heights.
std::uint64_t normalMapBytes(int width_px, int height_px, bool has_heights);

/// What the numbers of an image mean.
enum class MapContent {
  kAuto,     // heights if the image has one channel, or three that are equal everywhere
  kNormals,  // x, y, z in the first three channels, or x, y in two
  kHeights   // height in the first channel
};

/// Which way green, the normal's y, points in the picture.
enum class GreenAxis {
  kUp,   // towards the first row, as OpenGL's maps: against v
  kDown  // towards the last row, as Direct3D's maps: along v
};

struct NormalMapDecoding {
  MapContent content = MapContent::kAuto;
  GreenAxis green = GreenAxis::kUp;
  double height_scale = 0.05;  // height of a value of 1, in units of the map's side, finite
};

/// Reads a normal map from `image` as image_io gives it. Normals are stored as (n + 1) / 2 or as n
/// itself, whichever makes unit normals of more texels; they are made unit. The two values beside
/// the middle of 8 or 16 bits mean 0 where x and y both have them: flat stays flat. Throws Error
/// naming `name` and the texel for an empty or too large image, values that are not finite, normals
/// that are not unit (see kUnitTolerance) and normals that point down.
NormalMap decodeNormalMap(Image image, const std::string& name,
                          const NormalMapDecoding& decoding = {});

/// Normals of the periodic height field in the first channel of `heights` by central differences,
/// which become the map's where they are its only channel.
/// `height_scale` is the height of a value of 1 in units of the map's side. Throws Error as above.
NormalMap normalsFromHeights(Image heights, double height_scale, const std::string& name);

/// Loads `file` with `image_loader` (image_io's readNormals) and decodes it; the map's name is the
/// file's.
NormalMap readNormalMap(const std::filesystem::path& file,
                        const std::function<Image(const std::filesystem::path&)>& image_loader,
                        const NormalMapDecoding& decoding = {});

/// Throws Error unless `map` has a valid size, as many normals, and all are unit and point up.
void checkNormalMap(const NormalMap& map);

/// A normal read from a file may be this much longer or shorter than 1: eight bits and lossy
/// compression move it.
inline constexpr double kUnitTolerance = 0.3;
/// Share of a file's normals that may be off by more.
inline constexpr double kOutlierShare = 0.01;

}  // namespace glintmark
