// Whether bytes arrive: drivers say that they copied what they did not.
#pragma once
#include <cstddef>
#include <cstdint>

#include "host/ocl/opencl.h"

namespace glintmark {

/// Words of `target` that a read must overwrite, its last among them; `round` chooses others. Costs
/// nothing beside the read.
void plantCanaries(void* target, std::size_t bytes, std::uint32_t round);
/// Are some of them still there?
bool canariesLive(const void* target, std::size_t bytes, std::uint32_t round);

enum class Held { kAll, kOther, kUnread };

/// Does the buffer hold `source` from `offset` on? Looks at its two ends and at two places
/// between; kUnread if the driver did not even copy these back.
Held holdsBytes(const Buffer::Impl& buffer, const void* source, std::size_t bytes,
                std::size_t offset);

/// Throws Error (kExitNoDevice): "the driver of 'DEVICE' lost data: WHAT".
[[noreturn]] void throwLostData(const Buffer::Impl& buffer, const std::string& what);

}  // namespace glintmark
