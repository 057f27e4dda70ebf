#include "host/frame/effect/glint_table.h"

#include "host/fit/slope_dictionary.h"
#include "host/ocl/upload.h"

namespace glintmark {

std::optional<Buffer> glintTable(Device& device, const KernelConfig& config,
                                 BufferPurpose purpose) {
  if (!config.glint) return {};
  switch (config.method) {
    case GlintMethod::kChermain:
      return upload(device, slopeDictionary(SlopeDraws::kIndependent), purpose);
    case GlintMethod::kChermainCorrected:
      return upload(device, slopeDictionary(SlopeDraws::kStratified), purpose);
    default:
      return {};
  }
}

}  // namespace glintmark
