#include "host/ocl/static_counts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

namespace glintmark {
namespace {

// A PoCL binary is an archive: name length, name, content length, content; lengths in 4 bytes.
// Local size 0-0-0 marks the version for any local size.
std::optional<std::string> objectInArchive(const std::string& archive, const std::string& kernel) {
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

// Hashing grid cells multiplies integers more often than all that is around it. The first cells may
// be hashed in front of the loop over the others, which then has a little less than half of the
// multiplications: it is the tightest loop with a third of them.
const LoopCounts* findCellLoop(const std::vector<LoopCounts>& loops) {
  std::size_t most = 0;
  for (const LoopCounts& loop : loops) most = std::max(most, loop.multiplies);
  const LoopCounts* chosen = nullptr;
  for (const LoopCounts& loop : loops) {
    const bool hashes = loop.multiplies > 0 && 3 * loop.multiplies > most;
    if (hashes && (!chosen || loop.instructions < chosen->instructions)) chosen = &loop;
  }
  return chosen;
}

}  // namespace

std::optional<std::string> sharedObject(const Program& program, const std::string& kernel_name) {
  return objectInArchive(program.binary(), kernel_name);
}

StaticCounts countInstructions(const std::vector<Instruction>& instructions) {
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
  const std::optional<std::string> object = sharedObject(program, kernel_name);
  if (!object) return std::nullopt;
  const std::optional<FunctionCode> code =
      findFunction(*object, fmt::format("_pocl_kernel_{}_workgroup", kernel_name).c_str());
  if (!code) return std::nullopt;
  const std::optional<std::vector<Instruction>> instructions = disassemble(*code);
  if (!instructions) return std::nullopt;
  return countInstructions(*instructions);
}

}  // namespace glintmark
