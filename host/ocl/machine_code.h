// x86-64 machine code: its instructions, and its loops as far as counts of them go.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace glintmark {

struct Instruction {
  std::uint64_t address = 0;
  bool vector_512 = false;  // names a 512-bit register
  bool multiply = false;    // of integers
  bool call = false;
  bool falls_through = true;                 // the next instruction may follow
  std::optional<std::uint64_t> jump_target;  // nothing also for jumps to a computed address
};

/// A function as it stands in an executable file.
struct FunctionCode {
  std::uint64_t address = 0;
  std::vector<std::uint8_t> bytes;
};

/// The machine code of `function` in an x86-64 ELF file given as its bytes; nothing if these are no
/// such file, or the function is not defined in it.
std::optional<FunctionCode> findFunction(std::span<const char> elf_file, const char* function);

/// The instructions of `code` in order of their addresses, padding left out; nothing if some bytes
/// are no instruction that the disassembler knows, for then what follows would be guessed.
std::optional<std::vector<Instruction>> disassemble(const FunctionCode& code);

/// A natural loop: the instructions from which its head can be reached again without leaving it.
struct LoopCounts {
  std::size_t instructions = 0;
  std::size_t vector_512 = 0;
  std::size_t multiplies = 0;     // of integers
  std::size_t calls = 0;          // functions that were not inlined
  int depth = 0;                  // loops around this one
  std::size_t longest_inner = 0;  // instructions of the longest loop inside it, 0 if innermost
};

/// The loops of a function, by the address of their heads.
std::vector<LoopCounts> findLoops(const std::vector<Instruction>& instructions);

}  // namespace glintmark
