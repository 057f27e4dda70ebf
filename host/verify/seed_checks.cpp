// Seeds and random numbers as kernels/README.md, "The draws", states them.
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "host/harness/probes.h"
#include "host/harness/seed_cases.h"
#include "host/reference/seeds.h"
#include "host/verify/check_groups.h"

namespace glintmark {
namespace {

// Steps 3 to 6, in integers.
Finding seeds(const CheckContext& context) {
  const std::vector<std::int32_t> u = interestingIndices();
  std::vector<std::int32_t> v = u, ju(u.size()), jv(u.size());
  std::ranges::reverse(v);
  std::mt19937 random(8);
  std::vector<reference::HalfVectorIndex> half(u.size());
  for (std::size_t i = 0; i < u.size(); ++i) {
    half[i] = {static_cast<std::int32_t>(random()) >> 4, static_cast<std::int32_t>(random()) >> 4};
    const std::uint32_t seed = reference::cellSeed(u[i], v[i]);
    ju[i] = (half[i].u + static_cast<std::int32_t>(seed & 0xFFFFu)) >> 16;
    jv[i] = (half[i].v + static_cast<std::int32_t>(seed >> 16)) >> 16;
  }
  const HashProbe probe = probeHash(context.bench, u, v, ju, jv, context.lanes);
  double different = 0;
  for (std::size_t i = 0; i < u.size(); ++i) {
    const std::uint32_t cell = reference::cellSeed(u[i], v[i]);
    different += static_cast<std::int32_t>(probe.coherent_u[i]) != reference::coherentIndex(u[i]) ||
                 probe.cell_seed[i] != cell ||
                 probe.pair_seed[i] != reference::pairSeed(cell, half[i]);
  }
  Finding finding(0);
  finding.add(different);
  return finding;
}

// U(h) in units of its last place, and the sum of four bytes.
Finding randomNumbers(const CheckContext& context) {
  std::vector<std::uint32_t> bits = {0, 1, 0x7FFFFFFFu, 0x80000000u, 0xFFFFFFFFu, 0xFF00FF00u};
  std::mt19937 random(9);
  for (int i = 0; i < 4096; ++i) bits.push_back(static_cast<std::uint32_t>(random()));
  const RandomProbe probe = probeRandom(context.bench, bits, context.lanes);
  Finding finding(1);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    finding.add(std::abs(probe.uniform[i] / reference::uniformOf(bits[i]) - 1) / 0x1p-23);
    finding.add(std::abs(probe.gauss[i] - reference::gaussOf(bits[i])) / 1e-6);
    finding.require(probe.uniform[i] > 0, "a uniform random number is 0");
  }
  return finding;
}

}  // namespace

std::vector<Check> seedChecks() {
  return {{"seeds/integers", "seeds that differ from the definition", seeds},
          {"seeds/random_numbers", "error in units of the last place", randomNumbers}};
}

}  // namespace glintmark
