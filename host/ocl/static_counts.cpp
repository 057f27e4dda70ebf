#include "host/ocl/static_counts.h"

#include <fmt/format.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <system_error>

namespace glintmark {
namespace {

// A PoCL binary is an archive: name length, name, content length, content; lengths in 4 bytes.
// Local size 0-0-0 marks the version for any local size.
std::optional<std::string> sharedObject(const std::string& archive, const std::string& kernel) {
  const std::string name = fmt::format("/{0}/0-0-0/{0}.so", kernel);
  const std::size_t at = archive.find(name);
  if (at == std::string::npos) return std::nullopt;
  std::uint32_t size = 0;
  const std::size_t content = at + name.size() + sizeof size;
  if (content > archive.size()) return std::nullopt;
  std::memcpy(&size, archive.data() + at + name.size(), sizeof size);
  if (size > archive.size() - content) return std::nullopt;
  return archive.substr(content, size);
}

// Output of `objdump` on `object`; nothing if it cannot be run.
std::optional<std::string> disassemble(const std::string& object) {
  std::error_code error;
  std::string path =
      (std::filesystem::temp_directory_path(error) / "glintmark-kernel-XXXXXX").string();
  const int file = error ? -1 : mkstemp(path.data());
  if (file < 0) return std::nullopt;
  const bool written =
      ::write(file, object.data(), object.size()) == static_cast<ssize_t>(object.size());
  ::close(file);

  std::string text;
  int status = -1;
  if (FILE* pipe =
          written ? popen(("objdump -d --no-show-raw-insn '" + path + "' 2>/dev/null").c_str(), "r")
                  : nullptr) {
    std::array<char, 1 << 16> part;
    for (std::size_t n; (n = fread(part.data(), 1, part.size(), pipe)) > 0;)
      text.append(part.data(), n);
    status = pclose(pipe);
  }
  ::unlink(path.c_str());
  if (status != 0) return std::nullopt;
  return text;
}

// Hashing a grid cell multiplies integers more often than all address arithmetic around it, so the
// loop over cells is the tightest one with most of the multiplications.
const LoopCounts* findCellLoop(const std::vector<LoopCounts>& loops) {
  std::size_t most = 0;
  for (const LoopCounts& loop : loops) most = std::max(most, loop.multiplies);
  const LoopCounts* chosen = nullptr;
  for (const LoopCounts& loop : loops) {
    const bool hashes = loop.multiplies > 0 && 2 * loop.multiplies > most;
    if (hashes && (!chosen || loop.instructions < chosen->instructions)) chosen = &loop;
  }
  return chosen;
}

}  // namespace

std::optional<StaticCounts> countInstructions(const std::string& disassembly,
                                              const std::string& function) {
  const std::vector<Instruction> instructions = parseFunction(disassembly, function);
  if (instructions.empty()) return std::nullopt;
  StaticCounts counts;
  counts.kernel_instructions = instructions.size();
  counts.vector_512 =
      static_cast<std::size_t>(std::ranges::count_if(instructions, &Instruction::vector_512));
  counts.loops = findLoops(instructions);
  if (const LoopCounts* cell_loop = findCellLoop(counts.loops))
    counts.cell_loop_instructions = cell_loop->instructions;
  return counts;
}

std::optional<StaticCounts> staticCounts(const Program& program, const std::string& kernel_name) {
  const std::optional<std::string> object = sharedObject(program.binary(), kernel_name);
  if (!object) return std::nullopt;
  const std::optional<std::string> text = disassemble(*object);
  if (!text) return std::nullopt;
  return countInstructions(*text, fmt::format("_pocl_kernel_{}_workgroup", kernel_name));
}

}  // namespace glintmark
