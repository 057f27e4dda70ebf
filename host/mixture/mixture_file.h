// Fitted mixtures as a file of their own.
//
//   "glintmark.mixtures/VERSION\n", the bytes of mixtureBytes, FNV-1a of those bytes (8 bytes);
// numbers in the machine's order. mixtureBytes is width, height, lobes, fit time, a report per
// level, then `lobes` float4 a texel from the finest level to 1x1: (a, a x, a y, a (2 s^2 +
// |m|^2)).
#pragma once
#include <string>
#include <string_view>

#include "host/mixture/normal_mixture.h"

namespace glintmark {

/// The whole file.
std::string serializeMixtures(const NormalMixtures& mixtures);

/// Inverse of serializeMixtures. Throws Error naming `name` if the bytes are no such file, are of
/// another version, truncated or damaged.
NormalMixtures parseMixtures(std::string_view file, const std::string& name);

}  // namespace glintmark
