#include "host/ocl/static_counts.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <span>
#include <string>
#include <string_view>

#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

constexpr std::size_t kFmaChains = 12;  // of probe.cl

// An outer loop (10..31) around an inner one (20..2a); its tail lies before its head, as compilers
// like to place it, so that the jump at 30 goes back without closing a loop of its own.
const FunctionCode kLoops = {8,
                             {
                                 0x55,                                // 08 push rbp
                                 0xeb, 0x0d,                          // 09 jmp 18
                                 0x66, 0x2e, 0x0f, 0x1f, 0x00,        // 0b cs nopw [rax]
                                 0x62, 0xf1, 0x74, 0x48, 0x58, 0xda,  // 10 vaddps zmm3, zmm1, zmm2
                                 0x74, 0x28,                          // 16 je 40
                                 0x31, 0xc0,                          // 18 xor eax, eax
                                 0x66, 0x90,                          // 1a xchg ax, ax
                                 0xcc, 0xcc, 0xcc, 0xcc,              // 1c int3
                                 0x62, 0xf2, 0x75, 0x48, 0x40, 0xd0,  // 20 vpmulld zmm2, zmm1, zmm0
                                 0xe8, 0xd5, 0xff, 0xff, 0xff,        // 26 call 0
                                 0x75, 0xf3,                          // 2b jne 20
                                 0x0f, 0xaf, 0xc8,                    // 2d imul ecx, eax
                                 0xeb, 0xde,                          // 30 jmp 10
                                 0x0f, 0x1f, 0x84, 0x00, 0,    0,    0, 0,  // 32 nopl [rax + rax]
                                 0x0f, 0x1f, 0x44, 0x00, 0x00, 0x90,  // 3a nopl [rax + rax], nop
                                 0x5d,                                // 40 pop rbp
                                 0xc3,                                // 41 ret
                             }};

TEST(StaticCounts, NaturalLoopsOfMachineCode) {
  const auto instructions = disassemble(kLoops);
  ASSERT_TRUE(instructions);
  const StaticCounts counts = countInstructions(*instructions);
  EXPECT_EQ(counts.kernel_instructions, 12u);
  EXPECT_EQ(counts.vector_512, 2u);
  ASSERT_EQ(counts.loops.size(), 2u);
  // The loop around is entered in its middle, at 18.
  const LoopCounts &outer = counts.loops[0], &inner = counts.loops[1];
  EXPECT_EQ(outer.instructions, 8u);
  EXPECT_EQ(outer.multiplies, 2u);
  EXPECT_EQ(outer.depth, 0);
  EXPECT_EQ(outer.longest_inner, 3u);
  EXPECT_EQ(inner.instructions, 3u);
  EXPECT_EQ(inner.vector_512, 1u);
  EXPECT_EQ(inner.multiplies, 1u);
  EXPECT_EQ(inner.calls, 1u);
  EXPECT_EQ(inner.depth, 1);
  EXPECT_EQ(inner.longest_inner, 0u);
  EXPECT_EQ(counts.cell_loop_instructions, inner.instructions) << "half of the products";
}

TEST(StaticCounts, WhereInstructionsLeadTo) {
  const auto instructions =
      disassemble({0,
                   {
                       0x62, 0xf2, 0x7d, 0x49, 0x92, 0x04, 0x88,  // vgatherdps
                       0xff, 0xe0,                                // jmp rax
                       0x3e, 0xff, 0xe1,                          // notrack jmp rcx
                       0xf3, 0xc3,                                // repz ret
                       0xf2, 0xeb, 0xf0,                          // bnd jmp 1
                   }});
  ASSERT_TRUE(instructions);
  ASSERT_EQ(instructions->size(), 5u);
  EXPECT_TRUE((*instructions)[0].vector_512) << "only its index is a register of that width";
  EXPECT_TRUE((*instructions)[0].falls_through);
  for (std::size_t i = 1; i < 5; ++i) {
    EXPECT_FALSE((*instructions)[i].falls_through) << i;
    EXPECT_EQ((*instructions)[i].jump_target.has_value(), i == 4) << i;
  }
  EXPECT_EQ((*instructions)[4].jump_target, 1u);
}

TEST(StaticCounts, StraightCodeHasNoLoopAndBytesThatAreNoneNoCounts) {
  const auto straight = disassemble({0, {0xc3}});
  ASSERT_TRUE(straight);
  const StaticCounts counts = countInstructions(*straight);
  EXPECT_EQ(counts.kernel_instructions, 1u);
  EXPECT_EQ(counts.cell_loop_instructions, 0u);
  EXPECT_TRUE(counts.loops.empty());
  EXPECT_EQ(countInstructions({}).kernel_instructions, 0u);
  EXPECT_FALSE(disassemble({0, {0xc3, 0x06}})) << "06 is no instruction of x86-64";
  EXPECT_FALSE(disassemble({0, {0xc3, 0xe8, 0x00}})) << "half a call";
}

extern "C" __attribute__((noinline, used)) int glintmarkFunctionToFind(int n) {
  return n + 1;
}

TEST(StaticCounts, FunctionsOfAnElfFile) {
  std::ifstream file("/proc/self/exe", std::ios::binary);
  const std::string program((std::istreambuf_iterator<char>(file)), {});
#ifdef __x86_64__
  const auto code = findFunction(program, "glintmarkFunctionToFind");
  ASSERT_TRUE(code);
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&glintmarkFunctionToFind);
  ASSERT_FALSE(code->bytes.empty());
  EXPECT_TRUE(std::ranges::equal(code->bytes, std::span(bytes, code->bytes.size())));
#endif
  EXPECT_FALSE(findFunction(program, "glintmarkFunctionToFin"));
  EXPECT_FALSE(findFunction(std::string_view(program).substr(0, 1000), "glintmarkFunctionToFind"));
  EXPECT_FALSE(findFunction(std::string("no ELF file"), "glintmarkFunctionToFind"));
  EXPECT_FALSE(findFunction(std::string(), "glintmarkFunctionToFind"));
}

class StaticCountsTest : public ProbeKernelsTest {
 protected:
  bool hasMachineCode() const {
#ifdef __x86_64__
    return device_.info().platform == "Portable Computing Language";
#else
    return false;
#endif
  }
  Device device_;
};

TEST_F(StaticCountsTest, FmaProbeIsTwelveVectorInstructionsAndNothingSpilled) {
  const int lanes = device_.info().default_lanes;
  const Program probe =
      ProgramCache(device_).getWithOptions("probes/probe.cl", "-D WIDTH=" + std::to_string(lanes));
  const auto counts = staticCounts(probe, "probeFma");
  EXPECT_FALSE(staticCounts(probe, "noSuchKernel"));
  ASSERT_EQ(counts.has_value(), hasMachineCode());
  if (!counts) return;
  ASSERT_FALSE(counts->loops.empty());
  const LoopCounts& chains = counts->loops.back();
  EXPECT_EQ(chains.longest_inner, 0u);
  EXPECT_EQ(chains.instructions, kFmaChains + 2) << "the chains, a decrement and a jump";
  if (lanes == 16) {
    EXPECT_EQ(chains.vector_512, kFmaChains);
  }
  EXPECT_GT(counts->kernel_instructions, chains.instructions);
}

TEST_F(StaticCountsTest, BinariesFromDiskCountTheSame) {
  const auto build = [&] { return ProgramCache(device_).getWithOptions("probes/probe.cl", ""); };
  const Program fresh = build(), stored = build();
  ASSERT_TRUE(stored.fromDiskCache());
  const auto a = staticCounts(fresh, "probeTriad"), b = staticCounts(stored, "probeTriad");
  ASSERT_EQ(a.has_value(), hasMachineCode());
  ASSERT_EQ(b.has_value(), a.has_value());
  if (a) {
    EXPECT_EQ(a->kernel_instructions, b->kernel_instructions);
  }
}

}  // namespace
}  // namespace glintmark
