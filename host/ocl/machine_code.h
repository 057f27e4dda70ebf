// x86-64 machine code as objdump prints it: its instructions and its loops.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace glintmark {

struct Instruction {
  std::uint64_t address = 0;
  bool vector_512 = false;  // names a 512-bit register
  bool multiply = false;    // of integers
  bool call = false;
  bool falls_through = true;  // the next instruction may follow
  std::optional<std::uint64_t> jump_target;
};

/// A natural loop: the instructions from which its head can be reached again without leaving it.
struct LoopCounts {
  std::size_t instructions = 0;
  std::size_t vector_512 = 0;
  std::size_t multiplies = 0;     // of integers
  std::size_t calls = 0;          // functions that were not inlined
  int depth = 0;                  // loops around this one
  std::size_t longest_inner = 0;  // instructions of the longest loop inside it, 0 if innermost
};

/// The instructions of `function` in the output of `objdump -d --no-show-raw-insn`, padding left
/// out; empty if it is not in there.
std::vector<Instruction> parseFunction(const std::string& disassembly, const std::string& function);

/// The loops of a function, by the address of their heads.
std::vector<LoopCounts> findLoops(const std::vector<Instruction>& instructions);

}  // namespace glintmark
