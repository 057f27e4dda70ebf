// Which material a pixel shows, as compositing programs read it: Cryptomatte 1.2, Friedman and
// Jones 2015 (github.com/Psyop/Cryptomatte).
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "host/codec/image_codec.h"
#include "host/core/image.h"

namespace glintmark {

/// MurmurHash3's 32 bits for x86, seed 0.
std::uint32_t murmurHash3(std::string_view text);

/// A name's hash as a float that is no subnormal, infinity or NaN: the exponent's last bit is
/// flipped where it would be.
float cryptomatteId(std::string_view name);

/// Adds the channels of rank 0 and 1 to an image of planes that has a channel "material", an index
/// into `materials` or -1 for none: its id with coverage 1, since a pixel has one sample. Throws
/// Error if there is no such channel or material.
void addMaterialMatte(Image& planes, std::span<const std::string> materials);

/// What the file has to say of these channels: layer, hash, conversion and the names' hashes.
PictureFacts matteFacts(std::span<const std::string> materials);

}  // namespace glintmark
