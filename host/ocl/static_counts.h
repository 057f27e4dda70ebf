// Static instruction counts of a compiled kernel, where the device gives its machine code.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "host/ocl/compute.h"
#include "host/ocl/machine_code.h"

namespace glintmark {

struct StaticCounts {
  std::size_t kernel_instructions = 0;
  std::size_t cell_loop_instructions = 0;  // tightest loop around the hashes; 0 if none
  std::size_t vector_512 = 0;              // in the whole kernel
  std::vector<LoopCounts> loops;           // by the address of their heads
};

/// Counts of `kernel_name`, work-item loop included, padding excluded. The code is PoCL's version
/// for any local size, taken from the program's binary, so that the counts do not depend on what
/// was launched. Nothing if the device is not PoCL on x86-64, or the disassembler does not know one
/// of the instructions.
std::optional<StaticCounts> staticCounts(const Program& program, const std::string& kernel_name);

/// PoCL's version for any local size of a kernel as the bytes of an ELF shared object, which
/// disassemblers read; nothing if the device is not PoCL.
std::optional<std::string> sharedObject(const Program& program, const std::string& kernel_name);

/// Counts of one function's instructions.
StaticCounts countInstructions(const std::vector<Instruction>& instructions);

}  // namespace glintmark
