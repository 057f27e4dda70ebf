// How much memory is left to take.
#pragma once
#include <cstdint>
#include <filesystem>
#include <string>

namespace glintmark {

/// Memory that this process can still take [bytes]: what is free in the machine, in its control
/// groups and below its address-space limit, whichever is least; 0 if nobody says. `root` stands
/// for the folder "/".
std::uint64_t freeMemoryBytes(const std::filesystem::path& root = "/");

/// Throws Error if less than `bytes` are free; `what` begins the sentence, for example the name of
/// the file that asks for them. A few megabytes are always taken to be there.
void requireMemory(std::uint64_t bytes, const std::string& what);

}  // namespace glintmark
