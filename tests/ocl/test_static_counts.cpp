#include "host/ocl/static_counts.h"

#include <cstdlib>

#include "tests/ocl/ocl_test.h"

namespace glintmark {
namespace {

constexpr std::size_t kFmaChains = 12;  // of probe.cl

// An outer loop (10..2f) around an inner one (20..28); its tail lies before its head, as compilers
// like to place it, so that the jump at 30 goes back without closing a loop of its own.
constexpr const char* kListing = R"(
Disassembly of section .text:

0000000000000000 <other>:
       0:	ret

0000000000000008 <kernel_workgroup>:
       8:	push   %rbp
       9:	jmp    18 <kernel_workgroup+0x10>
       c:	data16 cs nop 0x0(%rax,%rax,1)
      10:	vaddps %zmm1,%zmm2,%zmm3
      14:	dec    %rcx
      16:	je     40 <kernel_workgroup+0x38>
      18:	xor    %eax,%eax
      1a:	xchg   %ax,%ax
      20:	vpmulld %zmm0,%zmm1,%zmm2
      24:	call   0 <other>
      26:	dec    %eax
      28:	jne    20 <kernel_workgroup+0x18>
      30:	jmp    10 <kernel_workgroup+0x8>
      40:	pop    %rbp
      41:	ret

0000000000000050 <later>:
      50:	jmp    50 <later>
)";

TEST(StaticCounts, NaturalLoopsOfAListing) {
  const auto counts = countInstructions(kListing, "kernel_workgroup");
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->kernel_instructions, 13u);
  EXPECT_EQ(counts->vector_512, 2u);
  ASSERT_EQ(counts->loops.size(), 2u);
  const LoopCounts &outer = counts->loops[0], &inner = counts->loops[1];
  EXPECT_EQ(outer.instructions, 9u);
  EXPECT_EQ(outer.depth, 0);
  EXPECT_EQ(outer.longest_inner, 4u);
  EXPECT_EQ(inner.instructions, 4u);
  EXPECT_EQ(inner.vector_512, 1u);
  EXPECT_EQ(inner.multiplies, 1u);
  EXPECT_EQ(counts->cell_loop_instructions, inner.instructions);
  EXPECT_EQ(inner.calls, 1u);
  EXPECT_EQ(inner.depth, 1);
  EXPECT_EQ(inner.longest_inner, 0u);
}

TEST(StaticCounts, StraightCodeHasNoLoopAndUnknownNamesNoCounts) {
  const auto counts = countInstructions(kListing, "other");
  ASSERT_TRUE(counts);
  EXPECT_EQ(counts->kernel_instructions, 1u);
  EXPECT_EQ(counts->cell_loop_instructions, 0u);
  EXPECT_TRUE(counts->loops.empty());
  EXPECT_FALSE(countInstructions(kListing, "workgroup"));
  EXPECT_FALSE(countInstructions("", "other"));
}

class StaticCountsTest : public ProbeKernelsTest {
 protected:
  bool hasMachineCode() const {
    return device_.info().platform == "Portable Computing Language" &&
           std::system("objdump --version > /dev/null 2>&1") == 0;
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

TEST_F(StaticCountsTest, WithoutObjdumpThereAreNone) {
  const Program probe = ProgramCache(device_).getWithOptions("probes/probe.cl", "");
  const std::string path = getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  EXPECT_FALSE(staticCounts(probe, "probeFma"));
  setenv("PATH", path.c_str(), 1);
}

}  // namespace
}  // namespace glintmark
