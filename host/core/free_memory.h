// How much memory is left to take.
#pragma once
#include <cstdint>
#include <string>

namespace glintmark {

/// Memory that this process can still take: the least of what the system has, what its control
/// group allows and what its address space may grow by [bytes]; 0 if none of them is known.
std::uint64_t freeMemoryBytes();

/// Throws Error if less than `bytes` are free; `what` is the beginning of the sentence, for example
/// the name of the file that asks for them.
void requireMemory(std::uint64_t bytes, const std::string& what);

}  // namespace glintmark
