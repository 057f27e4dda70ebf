// What device buffers are for: by this they are counted, and named in messages.
#pragma once
#include <string_view>

namespace glintmark {

enum class BufferPurpose {
  kPlanes,
  kRadiance,
  kCellCounts,
  kOwners,
  kFrameParams,
  kMaterials,
  kScattering,
  kLights,
  kLightTaps,
  kTaps,
  kNormalMapLayouts,
  kNormalMaps,
  kAreaLights,
  kLightPictureLayouts,
  kLightPictures,
  kCosineTable,
  kSlopeDictionary,
  kSimulation,
  kMixtureFit,
  kMicrodetails,
  kProbe,
};

/// "the rasterized planes", ... as messages and traces say it.
std::string_view purposeName(BufferPurpose purpose);

}  // namespace glintmark
