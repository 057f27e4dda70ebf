// Procedural normal maps: height fields that repeat, each a surface of the papers' pictures.
//
//   flat    the plane
//   disk    carved disk: rosette, flutes, scrolls, beads, rings     [TAN05] Fig. 4 to 7
//   armour  staggered hemispherical scales                          [TAN05] Fig. 8
//   dunes   wind ripples on slow dunes                              [TAN05] Fig. 1
//   cloth   plain weave of twisted threads
//   bumps   fine random detail
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "host/filter/normal_map.h"

namespace glintmark {

struct NormalMapRecipe {
  std::string kind = "disk";
  int size_px = 512;        // texels per side, 1..kMaxNormalMapSize_px
  std::uint32_t seed = 1;   // of the random parts: dunes, cloth, bumps, and the disk's tool marks
  double height_scale = 1;  // multiplies all heights, finite
};

/// Names of the generators, in the order above.
std::vector<std::string> normalMapGenerators();

/// One channel of heights in units of the map's side, height_scale not applied. Throws Error for an
/// unknown kind (listing the known ones) or a size out of range.
Image generateHeights(const NormalMapRecipe& recipe);

/// The recipe's normals; named after its kind. Same bits for the same recipe.
NormalMap generateNormalMap(const NormalMapRecipe& recipe);

}  // namespace glintmark
