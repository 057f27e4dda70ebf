#include "host/ocl/buffer_purpose.h"

namespace glintmark {

std::string_view purposeName(BufferPurpose purpose) {
  switch (purpose) {
    case BufferPurpose::kPlanes:
      return "the rasterized planes";
    case BufferPurpose::kRadiance:
      return "the radiance";
    case BufferPurpose::kCellCounts:
      return "the cell counts";
    case BufferPurpose::kOwners:
      return "the materials of the pixels";
    case BufferPurpose::kFrameParams:
      return "the frame's parameters";
    case BufferPurpose::kMaterials:
      return "the materials";
    case BufferPurpose::kScattering:
      return "the materials' scattering";
    case BufferPurpose::kLights:
      return "the lights";
    case BufferPurpose::kLightTaps:
      return "the lights' shares of the taps";
    case BufferPurpose::kTaps:
      return "the lights' taps";
    case BufferPurpose::kNormalMapLayouts:
      return "the layouts of normal maps";
    case BufferPurpose::kNormalMaps:
      return "a filtered normal map";
    case BufferPurpose::kAreaLights:
      return "the area lights";
    case BufferPurpose::kLightPictureLayouts:
      return "the layouts of the lights' pictures";
    case BufferPurpose::kLightPictures:
      return "the lights' pictures";
    case BufferPurpose::kCosineTable:
      return "a table of linearly transformed cosines";
    case BufferPurpose::kSlopeDictionary:
      return "the dictionary of slopes";
    case BufferPurpose::kSimulation:
      return "the simulation";
    case BufferPurpose::kMixtureFit:
      return "the fit of mixtures";
    case BufferPurpose::kMicrodetails:
      return "the microdetails";
    case BufferPurpose::kProbe:
      return "a probe's values";
  }
  return "a buffer";
}

}  // namespace glintmark
