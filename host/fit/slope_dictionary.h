// The dictionary of slope distributions that glint methods chermain and chermain_corrected read.
// [CSDD20] Sect. 5; layout: kernels/glint/slope_dictionary.h
#pragma once
#include <vector>

#include "kernels/glint/slope_dictionary.h"

namespace glintmark {

/// Where slopes of lobes come from; kernels/README.md, "The draws of rivals", has the protocol.
enum class SlopeDraws {
  kIndependent,  // as the authors draw them: the dictionary's mean is not quite the surface's lobe
  kStratified    // every lobe's slopes over all distributions are even; its width is taken off
};

/// DICTIONARY_LEVELS * DICTIONARY_SIZE * DICTIONARY_NODES floats. Made when first asked for, in
/// half a second on two cores; from then on the same.
const std::vector<float>& slopeDictionary(SlopeDraws draws);

}  // namespace glintmark
